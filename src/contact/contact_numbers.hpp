#pragma once
#include "keyword/deck.hpp"

namespace courant {

/// Gives every contact of the deck an id of its own: without one it has its position among them, with that of
/// an earlier one, and a warning, the next that is free.
void number_contacts(Deck& deck, Diagnostics& diagnostics);

}  // namespace courant
