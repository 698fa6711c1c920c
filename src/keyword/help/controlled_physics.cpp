#include "keyword/help/controlled_physics.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace courant {
namespace {

bool begins_with(const std::string& text, const char* beginning) {
  return text.rfind(beginning, 0) == 0;
}

const std::vector<ControlledPhysics>& all_physics() {
  static const std::vector<const char*> by_temperature = {"MAT_JOHNSON_COOK",
                                                          "MAT_015",
                                                          "MAT_MODIFIED_JOHNSON_COOK",
                                                          "MAT_107",
                                                          "MAT_TABULATED_JOHNSON_COOK",
                                                          "MAT_224",
                                                          "MAT_ADD_THERMAL"};
  static const std::vector<ControlledPhysics> all = {
      {"CONTROL_AIRBAG", "airbags", {"AIRBAG"}},
      {"CONTROL_ALE", "ALE meshes", {"ALE", "CONSTRAINED_LAGRANGE", "INITIAL_VOLUME_FRACTION"}},
      {"CONTROL_CONTACT", "contact", {"CONTACT"}},
      {"CONTROL_CPM", "corpuscular gas particles", {"AIRBAG", "PARTICLE", "DEFINE_CPM"}},
      {"CONTROL_DISCRETE_ELEMENT",
       "discrete element spheres",
       {"ELEMENT_DISCRETE_SPHERE", "DEFINE_DE_", "BOUNDARY_DE_"}},
      {"CONTROL_EFG", "element-free Galerkin methods", {"SECTION_SOLID_EFG", "SECTION_SHELL_EFG"}},
      {"CONTROL_PORE", "pore pressures", {"BOUNDARY_PORE", "BOUNDARY_PWP", "INITIAL_PWP", "MAT_ADD_PORE"}},
      {"CONTROL_SPH", "particles", {"ELEMENT_SPH", "DEFINE_SPH", "DEFINE_ADAPTIVE_SOLID_TO_SPH"}},
      {"CONTROL_STAGED_CONSTRUCTION",
       "staged constructions",
       {"DEFINE_STAGED_CONSTRUCTION", "DEFINE_CONSTRUCTION_STAGES"}},
      {"INITIAL_TEMPERATURE", "materials that depend on the temperature", by_temperature},
      {"LOAD_THERMAL", "materials that depend on the temperature", by_temperature},
  };
  return all;
}

bool is_in(const Deck& deck, const ControlledPhysics& physics) {
  return std::any_of(physics.brought_by.begin(), physics.brought_by.end(), [&](const char* beginning) {
    const auto at = deck.keywords.lower_bound(beginning);
    return at != deck.keywords.end() && begins_with(at->first, beginning);
  });
}

}  // namespace

const ControlledPhysics* controlled_physics(const std::string& name) {
  for (const ControlledPhysics& physics : all_physics())
    if (begins_with(name + "_", (std::string(physics.control) + "_").c_str())) return &physics;
  return nullptr;
}

Diagnostics& HeldControls::held(const std::string& name, const ControlledPhysics& physics,
                                const Location& where) {
  return held_.try_emplace(name, DeferredFaults{.physics = &physics, .where = where}).first->second.faults;
}

void HeldControls::close(Deck& deck, Diagnostics& diagnostics) const {
  for (const auto& [name, held] : held_) {
    const bool there = is_in(deck, *held.physics);
    if (there)
      for (const Diagnostic& fault : held.faults.all()) diagnostics.add(fault);
    if (there || held.faults.all().empty()) continue;
    diagnostics.note(held.where, fmt::format("*{}: the deck has no {}: no effect", name, held.physics->what));
    KeywordUse& use = deck.keywords[name];
    use.treatment = Treatment::honoured;
    use.lacking.clear();
  }
}

}  // namespace courant
