#pragma once
// The content of a deck in a form for restart files, and its comparison with another deck.
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
  std::vector<std::string> lines;  ///< values of each entry, separated by tabs; none for many entries
};
using DeckRecord = std::vector<KeywordRecord>;

/// Records every keyword with a table. Call it before tables of the deck are released.
DeckRecord record_deck(const Deck& deck);

/// Differences with which a run can continue: end time, outputs, curves, TSSFAC, and fields without influence
/// on results. Others are errors that name file, line, column, keyword and field. Returns the allowed
/// differences, a line for each keyword.
std::vector<std::string> compare_decks(const DeckRecord& before, const Deck& deck, const DeckRecord& now,
                                       Diagnostics& diagnostics);

}  // namespace courant
