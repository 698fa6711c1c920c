#pragma once
#include "keyword/deck.hpp"
#include "rigid/bodies/rigid_cards.hpp"

namespace courant {

/// The one of this id; null where there is none.
const MatRigid* mat_rigid_of(const Deck& deck, Id mid);

}  // namespace courant
