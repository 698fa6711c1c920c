#pragma once
#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// Lets each card of a kind check itself, where it can: check(deck, model, diagnostics), or without the
/// model.
template <class Card>
void check_cards(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  for (const Card& card : deck.all<Card>())
    if constexpr (requires { card.check(deck, model, diagnostics); })
      card.check(deck, model, diagnostics);
    else if constexpr (requires { card.check(deck, diagnostics); })
      card.check(deck, diagnostics);
}

}  // namespace courant
