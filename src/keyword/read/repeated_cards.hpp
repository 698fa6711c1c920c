#pragma once
#include <cstdint>

#include "base/diagnostic.hpp"
#include "keyword/deck.hpp"

namespace courant {

/// Of a keyword that counts once (KeywordOf::once), by its location in the registry and among its names: of
/// several sets of cards the last stays in the deck. If it differs from the one before, there is a warning.
void keep_last_cards(Deck& deck, std::int32_t keyword, std::int32_t name, Diagnostics& diagnostics);

}  // namespace courant
