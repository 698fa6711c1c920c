// Curves over time that end before the run does.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "keyword/registry.hpp"
#include "model/model_builder.hpp"
#include "model/transforms/included_entries.hpp"

namespace courant {

namespace {

/// A number of the entry by the name of its field; `otherwise` where the keyword has none.
Real number_named(const KeywordSpec& spec, const Entry& entry, std::string_view name, Real otherwise) {
  for (std::size_t c = 0; c < spec.cards.size(); ++c)
    for (std::size_t f = 0; f < spec.cards[c].fields.size(); ++f)
      if (spec.cards[c].fields[f].name == name) return spec.number_of(entry, c, f);
  return otherwise;
}

/// Outputs and step limits go on as they are, which is no physics.
bool is_load_or_motion(const KeywordSpec& spec, std::string_view field) {
  if (!spec.lacking.empty() || !curve_dimensions(spec.names[0], field)) return false;
  const std::string& name = spec.names[0];
  return name.starts_with("LOAD_") || name.starts_with("DAMPING_") || name.starts_with("BOUNDARY_") ||
         name.starts_with("RIGIDWALL_");
}

}  // namespace

// What other programs make of a load beyond the last point of its curve differs: whoever reads the deck
// should know that the last value is held here. Each curve is told of once.
void ModelBuilder::warn_of_short_curves() {
  std::set<Id> told;
  const auto& registry = keyword_registry();
  for (std::size_t k = 0; k < registry.size(); ++k) {
    const KeywordSpec& spec = *registry[k];
    const bool asked = std::any_of(spec.cards.begin(), spec.cards.end(), [&](const CardSpec& card) {
      return std::any_of(card.fields.begin(), card.fields.end(),
                         [&](const FieldSpec& field) { return is_load_or_motion(spec, field.name); });
    });
    if (!asked) continue;
    spec.for_each(deck_, static_cast<std::int32_t>(k), [&](const Entry& entry) {
      spec.for_each_id(entry, [&](const IdUse& id) {
        const FieldSpec& field = spec.cards[id.card].fields[id.field];
        if (id.space != IdSpace::curve || !is_load_or_motion(spec, field.name)) return;
        const auto found = model_.curves.find(id.id);
        if (found == model_.curves.end() || found->second.ordinate.size() < 2)
          return;  // of one point: a constant
        const Real birth = number_named(spec, entry, "BIRTH", 0);
        const Real until = std::min(model_.endtim, number_named(spec, entry, "DEATH", model_.endtim));
        const Real last = birth + found->second.abscissa.back(), value = found->second.ordinate.back();
        constexpr Real rounded = 1e-6;
        if (value == 0 || !(last < until * (1 - rounded)) || !told.insert(id.id).second) return;
        deck_.warning(
            diagnostics_, entry, field.name,
            fmt::format("curve {} ends at t = {:g}, before the run does at {:g}: its last value {:g} is "
                        "held from there on",
                        id.id, last, until, value),
            "other programs go on with the last slope, or with 0: give the curve a point at the end");
      });
    });
  }
}

}  // namespace courant
