#include "model/mesh/named_parts.hpp"

#include <fmt/format.h>

namespace courant {

std::vector<Index> parts_named(const Deck& deck, const Model& model, const Entry& entry, const char* field,
                               Id id, int type, Diagnostics& diagnostics) {
  if (type == 2) {
    const auto set = model.part_sets.find(id);
    if (set == model.part_sets.end())
      deck.error(diagnostics, entry, field, fmt::format("part set {} does not exist", id),
                 "define it with *SET_PART_LIST");
    else if (set->second.empty())
      deck.error(diagnostics, entry, field, fmt::format("part set {} is empty", id));
    else
      return set->second;
  } else if (type == 3) {
    const auto part = model.part_of_id.find(id);
    if (part != model.part_of_id.end()) return {part->second};
    deck.error(diagnostics, entry, field, fmt::format("part {} does not exist", id), "define it with *PART");
  }
  return {};  // other types were refused by the card
}

std::vector<char> shell_parts_named(const Deck& deck, const Model& model, const Entry& entry,
                                    const char* field, Id id, int type, Diagnostics& diagnostics) {
  std::vector<char> chosen(model.parts.size(), 0);
  for (const Index part : parts_named(deck, model, entry, field, id, type, diagnostics)) {
    chosen[part] = 1;
    if (!model.parts[part].has_shell)
      deck.error(diagnostics, entry, field, fmt::format("part {} has no shells", model.parts[part].id),
                 fmt::format("{} must be parts of shells", field));
  }
  return chosen;
}

}  // namespace courant
