// *ELEMENT_MASS_PART and _SET: masses that are spread over the nodes of parts.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "elements/discrete/discrete.hpp"
#include "elements/discrete/discrete_cards.hpp"
#include "extension/additions.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

struct PartSetMassCard : PartMassCard {};

const RegisterKeyword<PartMassCard> element_mass_part{element_mass_part_table()};
const RegisterKeyword<PartSetMassCard> element_mass_part_set{element_mass_part_set_table()};

class PartMasses {
 public:
  PartMasses(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {}

  void add(const PartMassCard& card, const std::vector<Index>& parts, const char* field, bool by_mass) {
    if (card.addmass > 0 && card.finmass > 0)
      return error(card, "FINMASS", "is given with ADDMASS", "give one of them");
    if (!check_parts(card, parts, field, by_mass)) return;
    std::map<Index, Real> share;  // of the nodes: area, volume or mass
    Real all = 0, mass = 0;
    for (std::size_t k = 0; k < world_.groups.size(); ++k) {
      const ElementGroup& group = *world_.groups[k];
      if (std::find(parts.begin(), parts.end(), group.part) == parts.end()) continue;
      for (Index e = 0; e < group.size(); ++e) {
        const Real weight = by_mass ? group.mass[e] : size_of(group, e);
        all += weight, mass += group.mass[e];
        for (int c = 0; c < group.corners(); ++c) share[group.node.data(c)[e]] += weight * group.share(e, c);
      }
    }
    if (!(all > 0))
      return error(card, field, "the parts have no elements", "name parts with shells or solids");
    const Real added = card.finmass > 0 ? card.finmass - mass : card.addmass;
    if (added < 0)
      return error(card, "FINMASS", fmt::format("the mass is {:.6g} already", mass),
                   "mass cannot be taken away");
    for (const auto& [node, weight] : share) masses_[node] += added * weight / all;
  }

  void finish() {
    if (masses_.empty()) return;
    FieldSet& set = world_.add_set("masses of parts");
    set.resize(static_cast<Index>(masses_.size()));
    ElementGroup& group = *world_.groups.emplace_back(std::make_unique<ElementGroup>(set, no_part, 1));
    Index e = 0;
    for (const auto& [node, mass] : masses_) {
      group.id[e] = world_.nodes.id[node], group.node[e] = node, group.mass[e] = mass;
      world_.nodes.m[node] += mass;
      ++e;
    }
  }

 private:
  void error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  /// Of a shell that deforms its area, else the volume.
  Real size_of(const ElementGroup& group, Index e) const {
    return group.segment ? group.V0[e] / world_.segments.thickness[(*group.segment)[e]] : group.V0[e];
  }

  bool check_parts(const PartMassCard& card, const std::vector<Index>& parts, const char* field,
                   bool by_mass) {
    bool shells = false, solids = false;
    for (const Index p : parts) {
      const ModelPart& part = model_.parts[static_cast<std::size_t>(p)];
      shells = shells || part.has_shell, solids = solids || part.has_solid;
      if (part.has_sph || part.has_beam || part.rigid) {
        error(card, field,
              fmt::format("mass cannot be spread over {} part {}",
                          part.has_sph    ? "the particles of"
                          : part.has_beam ? "the beams of"
                                          : "the rigid",
                          part.id),
              part.rigid ? "give the body its mass by *PART_INERTIA, or nodes theirs by *ELEMENT_MASS"
                         : "name parts of shells that deform, or of solids");
        return false;
      }
    }
    if (shells && solids && !by_mass) {
      error(card, field, "the set has shells and solids, whose areas and volumes do not compare",
            "give each kind a card of its own, or spread by mass (MWD 1)");
      return false;
    }
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  std::map<Index, Real> masses_;  ///< by node of the world [M]
};

}  // namespace

void add_part_masses(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  PartMasses masses(deck, model, world, diagnostics);
  for (const PartMassCard& card : deck.all<PartMassCard>()) {
    const auto part = model.part_of_id.find(card.pid);
    if (part == model.part_of_id.end())
      deck.error(diagnostics, card, "PID", fmt::format("part {} does not exist", card.pid),
                 "define it with *PART");
    else
      masses.add(card, {part->second}, "PID", false);
  }
  for (const PartSetMassCard& card : deck.all<PartSetMassCard>()) {
    const auto set = model.part_sets.find(card.pid);
    if (set == model.part_sets.end())
      deck.error(diagnostics, card, "PSID", fmt::format("part set {} does not exist", card.pid),
                 "define it with *SET_PART_LIST");
    else
      masses.add(card, set->second, "PSID", card.mwd == 1);
  }
  masses.finish();
}

}  // namespace courant
