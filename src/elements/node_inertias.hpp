#pragma once
// *ELEMENT_INERTIA on nodes that no rigid body moves: they turn as a top does.
#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// Once rigid bodies have their nodes, and before start_rotations: gives each node its least principal moment
/// as rotary inertia, which the same about all axes is all that there is. Refuses by name: plane scenes,
/// offsets, tensors that leave an axis without inertia.
void add_rotary_inertias(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics);

/// Where moments differ: a pass that has such nodes turn as dL/dt = M, L = J omega, asks for. Refuses by
/// name: rotations that are prescribed or tied, and damping. Behind prescribed motions and tied contacts.
void add_inertia_tensors(const Deck& deck, const Model& model, bool damped, World& world,
                         Diagnostics& diagnostics);

}  // namespace courant
