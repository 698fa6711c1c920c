#pragma once
// What a deck says, in a form that a restart file can hold, and how another deck differs from it.
#include <cstdint>
#include <string>
#include <vector>

#include "keyword/deck.hpp"

namespace courant {

/// The entries of one keyword.
struct KeywordRecord {
  std::string name;  ///< the keyword's first name
  std::int64_t entries = 0;
  std::uint64_t sum = 0;           ///< checksum over all values of all entries
  std::vector<std::string> lines;  ///< each entry's values, apart by tabs; none where there are many entries
};
using DeckRecord = std::vector<KeywordRecord>;

/// Records every keyword with a table. Call it before tables of the deck are released.
DeckRecord record_deck(const Deck& deck);

/// Differences that a run can go on with: end time, outputs, curves, TSSFAC, and fields without influence on
/// results.
/// Others are errors that name file, line, column, keyword and field.
/// Returns what is different and allowed, a line for each keyword.
std::vector<std::string> compare_decks(const DeckRecord& before, const Deck& deck, const DeckRecord& now,
                                       Diagnostics& diagnostics);

}  // namespace courant
