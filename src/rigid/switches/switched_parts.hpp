#pragma once
#include "keyword/deck.hpp"
#include "state/world.hpp"

namespace courant {

/// Once all is built: contacts and rigid walls that *DEFORMABLE_TO_RIGID_AUTOMATIC asks for and that are not
/// there are errors.
void check_switches(const Deck& deck, const World& world, Diagnostics& diagnostics);

}  // namespace courant
