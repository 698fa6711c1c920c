#pragma once
#include "keyword/deck.hpp"

namespace courant {

/// The number that _ID gives a *BOUNDARY_PRESCRIBED_MOTION_NODE or _SET, by its card; 0: none.
Id motion_id(const Deck& deck, const Entry& card);
/// Whether any has this number.
bool has_motion_of_nodes(const Deck& deck, Id id);

}  // namespace courant
