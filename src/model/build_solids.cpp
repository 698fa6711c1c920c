// Solid elements: sets and counts know them; decks with solids are refused, as nothing computes them.
#include <fmt/format.h>
#include <unordered_map>

#include "model/cards_elements.hpp"
#include "model/model_builder.hpp"

namespace courant {

void ModelBuilder::build_solids() {
  const auto& cards = deck_.all<ElementSolidCard>();
  std::unordered_map<Id, const ElementSolidCard*> first;
  first.reserve(cards.size());
  model_.solids.reserve(cards.size());
  for (const ElementSolidCard& card : cards) {
    const auto [it, is_new] = first.try_emplace(card.eid, &card);
    if (!is_new) duplicate(card, "EID", "solid element", card.eid, deck_.where(*it->second));
    const Id ids[] = {card.n1, card.n2, card.n3, card.n4, card.n5,
                      card.n6, card.n7, card.n8, card.n9, card.n10};
    constexpr int least_corners = 4;
    ModelSolid solid;
    solid.id = card.eid;
    solid.part = part(card, "PID", card.pid);
    solid.node.fill(-1);
    bool whole = solid.part >= 0;
    for (std::size_t k = 0; k < solid.node.size(); ++k) {
      if (ids[k] == 0) continue;
      solid.node[k] = node(card, "EID", ids[k]);
      whole = whole && solid.node[k] >= 0;
    }
    for (int k = 0; k < least_corners; ++k) {
      if (ids[k] != 0) continue;
      error(card, "EID", fmt::format("solid element {} has less than four nodes", card.eid));
      whole = false;
      break;
    }
    if (whole) model_.solids.push_back(solid);
  }
}

}  // namespace courant
