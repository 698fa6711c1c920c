#pragma once
// The card of an ASCII history added by one file: its interval.
#include <string>
#include <utility>

#include "keyword/registry.hpp"

namespace courant {

/// Derive one type for each keyword.
struct HistoryInterval : Entry {
  Real dt = 0;
  int binary = 0, ioopt = 1;
  Id lcur = 0;
};

template <class Card>
KeywordOf<Card> history_interval(std::string name, std::string purpose) {
  return {.names = {std::move(name)},
          .purpose = std::move(purpose),
          .once = true,
          .many = false,
          .cards = {{.fields = {{"DT", &Card::dt, "T", "interval, 0 none", {.check = Check::not_negative}},
                                {"BINARY",
                                 &Card::binary,
                                 "-",
                                 "0 and 1 text, 2 binout, 3 both; history.h5 in any case",
                                 {.allowed = {0, 1, 2, 3}}},
                                {"LCUR",
                                 &Card::lcur,
                                 "-",
                                 "curve of intervals",
                                 {.honour = Honour::output_only, .refers = IdSpace::curve}},
                                {"IOOPT", &Card::ioopt, "-", "how LCUR counts", no_effect_but(1)}}}}};
}

/// Interval requested by the card of a deck; 0: not requested [T]
template <class Card>
Real interval_in(const Deck& deck) {
  const auto* card = deck.last<Card>();
  return card ? card->dt : 0;
}

/// BINARY of the card.
template <class Card>
int binary_in(const Deck& deck) {
  const auto* card = deck.last<Card>();
  return card ? card->binary : 1;
}

}  // namespace courant
