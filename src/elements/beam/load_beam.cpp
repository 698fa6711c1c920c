// *LOAD_BEAM_ELEMENT and _SET: a force per length on beams.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "elements/beam/beam_axes.hpp"
#include "elements/beam/beam_cards.hpp"
#include "extension/additions.hpp"
#include "keyword/registry.hpp"
#include "loads/middle_velocity.hpp"
#include "model/definitions/named_curve.hpp"
#include "model/sets/sets_cards.hpp"
#include "parallel/counting_sort.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

struct LoadBeam : LoadBeamFields {
  bool is_set() const { return name == 1; }
};
const RegisterKeyword<LoadBeam> load_beam{load_beam_element_table()};

struct LoadedBeam {
  const BeamAxes* of = nullptr;
  Index e = 0;
  int axis = 0;
  std::size_t load = 0;
};
struct LineLoad {
  Curve curve{};
  Real sf = 1;
};

/// Each node works out the beams that it is an end of, in the order of the deck.
class BeamLoads : public Force, public EnergyTerm {
 public:
  BeamLoads(std::vector<LineLoad> loads, std::vector<LoadedBeam> beams, World& world)
      : loads_(std::move(loads)), beams_(std::move(beams)) {
    std::vector<Index> node, beam, order;
    for (std::size_t k = 0; k < beams_.size(); ++k)
      for (int c = 0; c < 2; ++c)
        node.push_back(beams_[k].of->beams().node.data(c)[beams_[k].e]),
            beam.push_back(static_cast<Index>(k));
    counting_sort(node, world.nodes.size(), first_, order);
    for (const Index k : order) of_node_.push_back(beam[static_cast<std::size_t>(k)]);
  }
  std::string name() const override { return "forces along beams"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).updates(world.nodes.f);
    std::set<const BeamAxes*> passes;
    for (const LoadedBeam& one : beams_)
      if (passes.insert(one.of).second) {
        one.of->declare_axes(world, a);
        a.reads(one.of->beams().node, Reach::others);
        if (const auto* eroded = shared_fields::eroded.find(one.of->beams().fields))
          a.reads(*eroded, Reach::others);
      }
  }
  void start(World&, const Clock& clock) override {
    now_.clear();
    for (const LineLoad& load : loads_) now_.push_back(load.sf * load.curve(clock.t));
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index n = begin; n < end; ++n)
      if (acts_on(n)) world.nodes.f.add(n, force(world, n));
  }
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const Points points = points_of(world.nodes);
    const MiddleVelocity middle(points, clock);
    const auto work_on = [&](Index n) -> Real {
      if (!acts_on(n)) return 0;
      return force(world, n).dot(world.nodes.follow[n] ? world.nodes.v.vec(n) : middle(n)) * clock.dt_mean();
    };
    ledger.external_work += sum(world.nodes.size(), work_on);
    ledger.throughput += sum(world.nodes.size(), [&](Index n) { return std::abs(work_on(n)); });
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  bool acts_on(Index n) const {
    return first_[static_cast<std::size_t>(n)] < first_[static_cast<std::size_t>(n) + 1];
  }
  Vec force(const World& world, Index n) const {
    Vec out = Vec::Zero();
    for (Index k = first_[static_cast<std::size_t>(n)]; k < first_[static_cast<std::size_t>(n) + 1]; ++k) {
      const LoadedBeam& one = beams_[static_cast<std::size_t>(of_node_[static_cast<std::size_t>(k)])];
      const ElementGroup& group = one.of->beams();
      const auto* eroded = shared_fields::eroded.find(group.fields);
      if (eroded && (*eroded)[one.e] != 0) continue;
      const Real length =
          (world.nodes.x.vec(group.node.data(1)[one.e]) - world.nodes.x.vec(group.node.data(0)[one.e]))
              .norm();
      out += 0.5 * now_[one.load] * length * Vec(one.of->axes_of(world, one.e).col(one.axis));
    }
    return out;
  }

  std::vector<LineLoad> loads_;
  std::vector<LoadedBeam> beams_;
  std::vector<Index> first_, of_node_;  ///< beams of each node
  std::vector<Real> now_;               ///< of each load [M/T2]
};

class BeamLoadReader {
 public:
  BeamLoadReader(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), diagnostics_(diagnostics) {
    for (const auto* axes : world.passes.all<const BeamAxes>())
      for (Index e = 0; e < axes->beams().size(); ++e) at_[axes->beams().id[e]] = {axes, e};
  }
  void add(const LoadBeam& card) {
    const Curve* const curve = curve_named(deck_, model_, card, "LCID", card.lcid, diagnostics_);
    if (!curve) return;
    std::vector<Id> ids{card.eid};
    if (card.is_set()) {
      const auto& sets = deck_.all<SetBeam>();
      const auto set =
          std::find_if(sets.begin(), sets.end(), [&](const SetBeam& s) { return s.sid == card.eid; });
      if (set == sets.end())
        return error(card, fmt::format("beam set {} does not exist", card.eid), "define it with *SET_BEAM");
      ids = set->eids;
    }
    for (const Id id : ids) {
      const auto found = at_.find(id);
      if (found == at_.end())
        return error(card, fmt::format("{} is no beam with ELFORM 1, 2, 3 or 9", id),
                     "cables, discrete beams and beams of *MAT_NULL cannot be loaded by it");
      const auto& [of, e] = found->second;
      if (card.dal > 1 && !of->knows_section())
        return error(card, fmt::format("beam {} is a truss, which has no axes s and t", id),
                     "load it along r (DAL 1), or its nodes by *LOAD_NODE");
      beams_.push_back({of, e, card.dal - 1, loads_.size()});
    }
    loads_.push_back({*curve, card.sf});
  }
  void finish(World& world) {
    if (diagnostics_.ok() && !beams_.empty())
      world.passes.add(std::make_shared<BeamLoads>(std::move(loads_), std::move(beams_), world));
  }

 private:
  void error(const LoadBeam& card, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, "EID", std::move(message), std::move(hint));
  }
  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  std::map<Id, std::pair<const BeamAxes*, Index>> at_;
  std::vector<LineLoad> loads_;
  std::vector<LoadedBeam> beams_;
};

const RegisterAddition loads_on_beams{
    "*LOAD_BEAM", [](const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
      BeamLoadReader reader(deck, model, world, diagnostics);
      for (const LoadBeam& card : deck.all<LoadBeam>()) reader.add(card);
      reader.finish(world);
    }};

}  // namespace

/// A mirror turns t over.
std::string keep_side_of_beam(LoadBeamFields& card, const Affine& motion) {
  if (card.dal == 3 && motion.linear().determinant() < 0) card.sf = -card.sf;
  return {};
}

}  // namespace courant
