#pragma once
#include "keyword/deck.hpp"
#include "state/world.hpp"

namespace courant {

/// The nodes of parts that are one body while they are rigid, as indices into World::nodes.
struct SwitchedNodes : virtual Pass {
  virtual std::vector<std::vector<Index>> nodes_of_bodies() const = 0;
};

/// Once all is built: contacts and rigid walls that *DEFORMABLE_TO_RIGID_AUTOMATIC asks for and that are not
/// there are errors, and constraints that join nodes of such parts to others, as momentum would change.
void check_switches(const Deck& deck, const World& world, Diagnostics& diagnostics);

}  // namespace courant
