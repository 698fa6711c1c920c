#pragma once
#include "rigid/bodies/merge.hpp"
#include "rigid/bodies/rigid.hpp"

namespace courant {

/// Refuses body loads that act on some of the parts whose mass a body has: one body has one acceleration at
/// its centre.
void refuse_uneven_loads(const RigidBody& b, const BodyMerges& merges, const Deck& deck, const Model& model,
                         const World& world, Diagnostics& diagnostics);

}  // namespace courant
