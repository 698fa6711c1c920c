#pragma once
#include <memory>

#include "rigid/joints/joints.hpp"

namespace courant {

/// *CONSTRAINED_JOINT: adds their pass; false if there is none. Behind contacts, whose forces they take into
/// account. Velocities at the start that do not fit lose what joints do not allow, with a warning. Refuses
/// by name: nodes that are missing or on no rigid body, pairs on one body or at different positions, axes
/// without a direction, gears whose sense of turning nodes do not tell, curves that are not there or that
/// jump.
bool add_joints(const Deck& deck, const Model& model, std::shared_ptr<RigidBodies> bodies, World& world,
                Diagnostics& diagnostics);

}  // namespace courant
