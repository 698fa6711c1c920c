// Curves over time that end before the run does.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "keyword/registry.hpp"
#include "model/conditions/relaxation.hpp"
#include "model/model_builder.hpp"

namespace courant {

namespace {

/// A number of the entry by the name of its field; `otherwise` where the keyword has none.
Real number_named(const KeywordSpec& spec, const Entry& entry, std::string_view name, Real otherwise) {
  for (std::size_t c = 0; c < spec.cards.size(); ++c)
    for (std::size_t f = 0; f < spec.cards[c].fields.size(); ++f)
      if (spec.cards[c].fields[f].name == name) return spec.number_of(entry, c, f);
  return otherwise;
}

}  // namespace

// What other programs make of a load beyond the last point of its curve differs: whoever reads the deck
// should know that the last value is held here. Each curve is reported once.
void ModelBuilder::warn_of_short_curves() {
  std::set<Id> told;
  for_load_curves(deck_, [&](const Entry& entry, const char* field, Id id) {
    const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(entry.keyword)];
    const auto found = model_.curves.find(id);
    if (found == model_.curves.end() || found->second.ordinate.size() < 2 || found->second.silent ||
        found->second.by_formula || is_of_relaxation(field))
      return;                                                   // of one point: a constant
    if (deck_.keyword(entry).starts_with("*INITIAL_")) return;  // its end is where the load lets go
    const Real birth = number_named(spec, entry, "BIRTH", 0);
    const Real until = std::min(model_.endtim, number_named(spec, entry, "DEATH", model_.endtim));
    const Real last = birth + found->second.abscissa.back(), value = found->second.ordinate.back();
    constexpr Real rounded = 1e-6;
    if (value == 0 || !(last < until * (1 - rounded)) || !told.insert(id).second) return;
    deck_.warning(
        diagnostics_, entry, field,
        fmt::format("curve {} ends at t = {:g}, before the run does at {:g}: its last value {:g} is "
                    "held from there on",
                    id, last, until, value),
        "other programs go on with the last slope, or with 0: give the curve a point at the end");
  });
}

}  // namespace courant
