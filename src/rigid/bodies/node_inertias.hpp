#pragma once
#include <map>

#include "keyword/deck.hpp"
#include "rigid/bodies/rigid.hpp"

namespace courant {

/// *ELEMENT_INERTIA on nodes of a body, whose masses it has already: adds their tensors about the centre, and
/// moves masses with an offset there. They turn as the body does, or, where it has no inertia without them,
/// as *INITIAL_VELOCITY turns the node. `world_node`: indices into World::nodes by id. False where the body
/// has a given inertia, which is reported.
bool add_node_inertias(const Deck& deck, const Model& model, const std::map<Id, Index>& world_node,
                       const World& world, RigidBody& body, Diagnostics& diagnostics);

}  // namespace courant
