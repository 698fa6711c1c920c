#include "elements/solid/hourglass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "elements/solid/section_solid.hpp"
#include "model/conditions/condition_cards.hpp"

namespace courant {

namespace {

constexpr int assumed_strain = 6, total_strain = 7, of_shells = 8, enhanced_strain = 9;
/// LS-DYNA's advice: above it hourglass forces may make the solids unstable. Assumed strains are those of the
/// material with 1.
constexpr Real stable_qm = 0.15, stable_assumed = 1;

class Reader {
 public:
  Reader(const Deck& deck, Diagnostics& diagnostics)
      : deck_(deck), diagnostics_(diagnostics), control_(deck.last<ControlHourglass>()) {
    for (const Hourglass& card : deck.all<Hourglass>()) cards_.emplace(card.hgid, &card);
    if (const auto* bulk = deck.last<ControlBulkViscosity>())
      standard_.q1 = bulk->q1, standard_.q2 = bulk->q2;
  }

  SolidViscosity of(const ModelPart& part) {
    SolidViscosity out = standard_;
    if (part.hgid == 0) {
      take_global(part, out);
      return out;
    }
    const auto found = cards_.find(part.hgid);
    if (found == cards_.end()) {
      deck_.error(diagnostics_, part.card, "HGID", fmt::format("hourglass {} does not exist", part.hgid),
                  "define it with *HOURGLASS, or leave the field blank");
      return out;
    }
    const Hourglass& card = *found->second;
    out.q1 = card.q1, out.q2 = card.q2;
    if (card.ihq == 0)
      take_global(part, out);
    else
      take(card, "IHQ", card.ihq, part, out);
    if (card.qm != 0) {
      out.qm = card.qm;
      check_coefficient(card, "QM", out);
    }
    return out;
  }

 private:
  void take_global(const ModelPart& part, SolidViscosity& out) {
    if (!control_) return;
    if (control_->ihq != 0) take(*control_, "IHQ", control_->ihq, part, out);
    out.qm = control_->qh;
    check_coefficient(*control_, "QH", out);
  }

  void take(const Entry& card, const char* field, int ihq, const ModelPart& part, SolidViscosity& out) {
    if (ihq > 0 && ihq <= assumed_strain) {
      out.ihq = ihq;
      return;
    }
    if (!has_modes(part)) return;
    const bool kind_of_6 = ihq == total_strain || ihq == enhanced_strain;
    if (kind_of_6) out.ihq = assumed_strain;
    if (!told_.insert({&card, field}).second) return;
    if (kind_of_6)
      deck_.warning(diagnostics_, card, field,
                    fmt::format("{} is a variant of 6: the solids of part {} take 6", ihq, part.id),
                    "6 says the same without this warning");
    else if (ihq == of_shells)
      deck_.warning(diagnostics_, card, field,
                    fmt::format("8 is of shells: the solids of part {} take 1 (viscous)", part.id),
                    "give their part a *HOURGLASS of its own");
    else
      deck_.refuse(
          diagnostics_, card, field,
          fmt::format("'{}' is not supported for solids, as those of part {}", ihq, part.id),
          "supported values: 0 to 6; 1 to 3 are viscous, 4 and 5 a stiffness, 6 has assumed strains; 7 and 9 "
          "become 6");
  }

  /// Whether its solids have modes without a strain at their points.
  bool has_modes(const ModelPart& part) const { return solid_formulation(deck_, part).has_modes; }

  void check_coefficient(const Entry& card, const char* field, const SolidViscosity& of) {
    const Real value = of.qm, most = of.ihq == assumed_strain ? stable_assumed : stable_qm;
    if (value >= 0 && value <= most) return;
    if (!told_.insert({&card, field}).second) return;
    if (value < 0)
      deck_.error(diagnostics_, card, field, fmt::format("expected a number >= 0, got '{:g}'", value));
    else
      deck_.warning(diagnostics_, card, field,
                    fmt::format("hourglass control with a coefficient of {:g} may be unstable", value),
                    fmt::format("keep it at {:g} or below", most));
  }

  const Deck& deck_;
  Diagnostics& diagnostics_;
  const ControlHourglass* control_;
  std::map<Id, const Hourglass*> cards_;
  SolidViscosity standard_;
  std::set<std::pair<const Entry*, std::string>> told_;  ///< card and field
};

}  // namespace

std::vector<SolidViscosity> read_solid_viscosity(const Deck& deck, const Model& model,
                                                 Diagnostics& diagnostics) {
  std::vector<SolidViscosity> out(model.parts.size());
  Reader reader(deck, diagnostics);
  for (std::size_t k = 0; k < out.size(); ++k)
    if (model.parts[k].has_solid && !model.parts[k].rigid) out[k] = reader.of(model.parts[k]);
  return out;
}

}  // namespace courant
