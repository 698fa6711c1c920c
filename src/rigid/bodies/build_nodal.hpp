#pragma once
#include <map>

#include "rigid/bodies/nodal_bodies.hpp"
#include "rigid/bodies/rigid.hpp"

namespace courant {

/// A body of nodes with the mass and rotary inertia that elements gave them, or what the card gives, and its
/// start. `world_node`: indices into World::nodes by id. False where it is none, which is reported: plane
/// scenes, nodes without mass, constraints that are none of the whole body, body loads that differ between
/// its nodes.
bool build_nodal_body(const NodalBody& nodal, const Deck& deck, const Model& model,
                      const std::map<Id, Index>& world_node, World& world, RigidBody& body,
                      Diagnostics& diagnostics);

}  // namespace courant
