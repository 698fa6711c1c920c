// Definitions of kinds that are not supported: they stop a deck only where something refers to them.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "keyword/help/families.hpp"
#include "keyword/read/deck_reader.hpp"
#include "keyword/read/number.hpp"

namespace courant {

namespace {

/// What the first field of such a keyword numbers; none: not such a definition.
IdSpace space_of_definition(const std::string& name) {
  if (name.starts_with("MAT_ADD_") || name.starts_with("MAT_NONLOCAL"))
    return IdSpace::none;  // they act on the material, or part, that they name
  if (name.starts_with("MAT_")) return IdSpace::material;
  if (name.starts_with("EOS_")) return IdSpace::eos;
  if (name.starts_with("SECTION_")) return IdSpace::section;
  return IdSpace::none;
}

std::set<Id> ids_referred_to(const Deck& deck, IdSpace space) {
  std::set<Id> out;
  const auto& registry = keyword_registry();
  for (std::size_t k = 0; k < registry.size(); ++k) {
    const KeywordSpec& spec = *registry[k];
    const bool refers = std::any_of(spec.cards.begin(), spec.cards.end(), [&](const CardSpec& card) {
      return std::any_of(card.fields.begin(), card.fields.end(),
                         [&](const FieldSpec& field) { return field.rules.refers == space; });
    });
    if (!refers) continue;
    spec.for_each(deck, static_cast<std::int32_t>(k), [&](const Entry& entry) {
      spec.for_each_id(entry, [&](const IdUse& use) {
        if (!use.defines && use.space == space) out.insert(std::abs(use.id));
      });
    });
  }
  return out;
}

}  // namespace

bool DeckReader::defer_definition(const File& file, std::size_t line, const KeywordLine& keyword) {
  const IdSpace space = space_of_definition(keyword.name);
  if (space == IdSpace::none || why_without_effect(keyword.name) ||
      families().refusal(keyword.name).lacking.empty())
    return false;
  DataLines data(*file.source, line + 1);
  if (!data.done() && keyword.name.ends_with("_TITLE")) data.step();
  if (data.done()) return false;
  Id id = 0;
  if (!parse_integer(first_field(data, keyword), id)) return false;
  const IdOffsets& offsets = deck_.files[static_cast<std::size_t>(file.index)].conversion.offsets;
  definitions_.push_back({keyword.name, deck_.location(file.index, static_cast<int>(line) + 1, 1), space,
                          offsets.shifted(space, id)});
  return true;
}

void DeckReader::close_definitions() {
  std::map<IdSpace, std::set<Id>> used;
  std::set<std::string> stops;
  for (const Definition& one : definitions_) {
    const auto [ids, is_new] = used.try_emplace(one.space);
    if (is_new) ids->second = ids_referred_to(deck_, one.space);
    if (ids->second.contains(one.id)) {
      refuse(one.name, one.where);
      stops.insert(one.name);
    }
  }
  for (const Definition& one : definitions_) {
    if (stops.contains(one.name)) continue;
    if (refusals_.is_first(one.name, diagnostics_))
      diagnostics_.note(one.where, fmt::format("*{}: nothing refers to it: no effect", one.name));
    KeywordUse& use = deck_.keywords[one.name];
    use.treatment = Treatment::honoured;
    use.lacking.clear();
  }
}

}  // namespace courant
