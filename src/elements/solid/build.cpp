#include <fmt/format.h>

#include <map>

#include "elements/solid/section_solid.hpp"
#include "elements/solid/solids.hpp"

namespace courant {

std::vector<SolidPart> find_solid_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  std::vector<SolidPart> out(model.parts.size());
  bool any = false;
  for (const ModelPart& part : model.parts) any = any || (part.has_solid && !part.rigid);
  if (!any) return out;
  check_solid_sections(deck, model, diagnostics);
  const std::vector<SolidViscosity> viscosity = read_solid_viscosity(deck, model, diagnostics);
  std::map<Id, std::shared_ptr<StrengthLaw>> laws;
  std::string known;
  const int errors = diagnostics.errors();
  for (const StrengthEntry& kind : strength_registry()) {
    kind.check(deck, model, diagnostics);
    if (!kind.deviator_only) known += (known.empty() ? "*" : ", *") + kind.keyword;
  }
  if (diagnostics.errors() == errors)  // a law is made from valid cards
    for (const StrengthEntry& kind : strength_registry())
      for (const auto& [id, law] : kind.all(deck, model)) laws.emplace(id, law);
  else
    return out;
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    const ModelPart& part = model.parts[k];
    if (!part.has_solid || part.rigid) continue;
    out[k].viscosity = viscosity[k];
    const auto law = laws.find(part.mid);
    const std::string instead = deck.found_instead(IdSpace::material, part.mid);
    if (law == laws.end()) {
      deck.error(diagnostics, part.card, "MID",
                 fmt::format("the solids of part {} need a material with strength and id {}; {}", part.id,
                             part.mid, instead),
                 "add one of " + known + ", or a *MAT_RIGID, and give its id here");
    } else if (law->second->deviator_only()) {
      deck.error(diagnostics, part.card, "MID",
                 fmt::format("the material of part {} takes its pressure from an equation of state, which is "
                             "not supported for solids",
                             part.id),
                 "use one of " + known);
    } else {
      out[k].law = law->second;
    }
  }
  return out;
}

void build_solids(const Model& model, const std::vector<SolidPart>& parts, const std::vector<Index>& node_of,
                  World& world) {
  std::vector<std::vector<const ModelSolid*>> of_part(model.parts.size());
  for (const ModelSolid& solid : model.solids) of_part[solid.part].push_back(&solid);
  constexpr int corners = 8;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (!parts[k].law || of_part[k].empty()) continue;
    FieldSet& set = world.add_set(fmt::format("solids of part {}", model.parts[k].id));
    set.resize(static_cast<Index>(of_part[k].size()));
    ElementGroup& group =
        *world.groups.emplace_back(std::make_unique<ElementGroup>(set, static_cast<Index>(k), corners));
    for (Index e = 0; e < group.size(); ++e) {
      const ModelSolid& solid = *of_part[k][e];
      group.id[e] = solid.id;
      const std::array<Index, corners> corner = solid.corners();
      group.repeats_nodes = group.repeats_nodes || solid.different_corners() < corners;
      for (int c = 0; c < corners; ++c) group.node.data(c)[e] = node_of[corner[c]];
    }
  }
}

}  // namespace courant
