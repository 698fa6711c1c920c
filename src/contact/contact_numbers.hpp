#pragma once
#include "keyword/deck.hpp"

namespace courant {

/// Gives every contact of the deck a unique id: without an id that is its position among the contacts; with
/// the id of an earlier one it is the next free one, with a warning.
void number_contacts(Deck& deck, Diagnostics& diagnostics);

}  // namespace courant
