#pragma once
#include "keyword/deck.hpp"

namespace courant {

/// Whether _ID gives any *BOUNDARY_PRESCRIBED_MOTION_NODE or _SET this number.
bool has_motion_of_nodes(const Deck& deck, Id id);

}  // namespace courant
