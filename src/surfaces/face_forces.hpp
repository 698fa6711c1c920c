#pragma once
#include "state/world.hpp"

namespace courant {

/// Adds the pass that takes back what interfaces added to segments.contact_force a step ago, since several
/// may act on a face; once.
void add_clear_face_forces(World& world);

}  // namespace courant
