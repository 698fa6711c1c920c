#pragma once
#include "model/mesh/part_inertia.hpp"
#include "rigid/bodies/replaced_velocity.hpp"
#include "rigid/bodies/rigid.hpp"

namespace courant {

/// Mass, centre, inertia and velocity that *PART_INERTIA, or a card with the same fields, gives a body; false
/// where they are none, which is reported.
/// `of`: whose they are, as IRIGID may replace the velocity.
bool take_given_inertia(const Deck& deck, const Model& model, const World& world, const PartInertiaCard& card,
                        const InertiaBody& of, RigidBody& body, Diagnostics& diagnostics);

}  // namespace courant
