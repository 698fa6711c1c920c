#include "elements/beam/axial_preload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "elements/beam/beam_cards.hpp"
#include "elements/beam/beams.hpp"
#include "elements/kept_stress.hpp"
#include "keyword/registry.hpp"
#include "laws/strength/beam_stress.hpp"
#include "model/definitions/named_curve.hpp"
#include "model/sets/sets_cards.hpp"

namespace courant {

namespace {

using IA = InitialAxialForceBeam;
const RegisterKeyword<IA> initial_axial_force_beam{initial_axial_force_beam_table()};

class ForceReader {
 public:
  ForceReader(const Deck& deck, const Model& model, std::vector<BeamPart>& parts, Diagnostics& diagnostics)
      : deck_(deck), model_(model), parts_(parts), diagnostics_(diagnostics) {
    for (std::size_t k = 0; k < parts.size(); ++k)
      for (std::size_t e = 0; parts[k].law && e < parts[k].beams.size(); ++e)
        at_[parts[k].beams[e]->id] = {k, e};
  }

  void add(const IA& card) {
    const Curve* const curve = curve_named(deck_, model_, card, "LCID", card.lcid, diagnostics_);
    const auto& sets = deck_.all<SetBeam>();
    const auto set =
        std::find_if(sets.begin(), sets.end(), [&](const SetBeam& s) { return s.sid == card.bsid; });
    if (set == sets.end())
      error(card, "BSID", fmt::format("beam set {} does not exist", card.bsid), "define it with *SET_BEAM");
    if (set == sets.end() || !curve || curve->silent) return;
    AxialPreload::AxialForce force{*curve, end_of_preload(*curve), card.kbend != 0};
    for (Real& f : force.curve.ordinate) f *= card.scale;
    for (const Id id : set->eids)
      if (!add(card, id, force)) return;
  }

 private:
  void error(const IA& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }
  bool add(const IA& card, Id id, const AxialPreload::AxialForce& force) {
    const auto refuse = [&](std::string message, const char* hint) {
      error(card, "BSID", std::move(message), hint);
      return false;
    };
    const auto found = at_.find(id);
    if (found == at_.end())
      return refuse(fmt::format("{} is no beam with ELFORM 1, 3 or 9 that deforms", id),
                    "F0 of *MAT_CABLE_DISCRETE_BEAM, and of springs OFFSET, are forces at the start");
    BeamPart& part = parts_[found->second.first];
    if (part.points.empty())
      return refuse(part.null ? fmt::format("beam {} is of *MAT_NULL, which has no stress", id)
                              : fmt::format("beam {} has ELFORM 2, whose section has no points", id),
                    "use ELFORM 1, 3 or 9");
    const BeamMeasures& m = part.measures[found->second.second];
    Real most = 0;
    for (const Real f : force.curve.ordinate) most = std::abs(f) > std::abs(most) ? f : most;
    std::vector<Real> numbers;
    for (const HistoryVariable& h : part.law->history())
      numbers.resize(numbers.size() + static_cast<std::size_t>(h.components));
    std::vector<Real*> history;
    for (Real& h : numbers) history.push_back(&h);
    const Keeps kept = keeps_stress({most / m.A}, history, [&](const PointBlock& points) {
      Real across = 0;
      update_in_beam(*part.law, points, &across);
    });
    if (kept != Keeps::all)
      return error(card, "SCALE",
                   fmt::format("an axial force of {:.4g} is a stress of {:.4g} in beam {}, beyond what its "
                               "material yields at",
                               most, most / m.A, id),
                   "lower it, or give the beam a larger section"),
             false;
    part.preload.add(part.beams.size(), found->second.second, force);
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  std::vector<BeamPart>& parts_;
  Diagnostics& diagnostics_;
  std::map<Id, std::pair<std::size_t, std::size_t>> at_;
};

}  // namespace

Real end_of_preload(const Curve& curve) {
  for (std::size_t k = 1; k < curve.ordinate.size(); ++k)
    if (curve.ordinate[k] == 0 && curve.ordinate[k - 1] != 0) return curve.abscissa[k - 1];
  return curve.abscissa.back();
}

void AxialPreload::add(std::size_t beams, std::size_t e, const AxialForce& force) {
  of_beam_.resize(beams, -1);
  of_beam_[e] = static_cast<Index>(forces_.size());
  forces_.push_back(force);
}

void AxialPreload::hold(Index e, Real t, const std::vector<SectionPoint>& points, const BeamMeasures& m,
                        Field<Real>& stress, std::array<Real, 6>& sum) const {
  const Index k = of_beam_[static_cast<std::size_t>(e)];
  if (k < 0 || t > forces_[static_cast<std::size_t>(k)].until) return;
  const AxialForce& force = forces_[static_cast<std::size_t>(k)];
  const Real wanted = force.curve(t) / m.A, shift = wanted - sum[0] / m.A;
  for (std::size_t p = 0; p < points.size(); ++p) {
    Real& xx = stress.data(3 * static_cast<int>(p))[e];
    const Real change = force.keeps_bending ? shift : wanted - xx, A = points[p].share * m.A;
    xx += change;
    sum[0] += A * change;
    sum[2] += A * points[p].t * m.half_t * change, sum[3] -= A * points[p].s * m.half_s * change;
  }
}

void read_preloads(const Deck& deck, const Model& model, std::vector<BeamPart>& parts,
                   Diagnostics& diagnostics) {
  const auto& cards = deck.all<IA>();
  if (cards.empty() || !diagnostics.ok()) return;
  ForceReader reader(deck, model, parts, diagnostics);
  for (const IA& card : cards) reader.add(card);
}

}  // namespace courant
