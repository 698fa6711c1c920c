#pragma once
// Checks of numbers that depend on each other, which the tables of fields cannot express.
#include <fmt/format.h>

#include "keyword/deck.hpp"

namespace courant {

/// Of a card: a function of (holds, field, what, value, hint) that reports "expected WHAT, got 'VALUE'" at
/// the field where `holds` is false.
template <class Card>
auto expectations_of(const Card& card, const Deck& deck, Diagnostics& diagnostics) {
  return [card = &card, deck = &deck, diagnostics = &diagnostics](
             bool holds, const char* field, const char* what, Real value, const char* hint) {
    if (!holds)
      deck->error(*diagnostics, *card, field, fmt::format("expected {}, got '{:g}'", what, value), hint);
  };
}

}  // namespace courant
