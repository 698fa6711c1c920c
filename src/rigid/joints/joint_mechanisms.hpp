#pragma once
#include <vector>

#include "rigid/joints/joint_rows.hpp"

namespace courant {

/// Of each joint, whether its mechanism has a closed loop: equations may say the same twice there, and
/// contradict each other where places and axes are a little off. What holds or drives a body counts as a
/// joint to the ground.
std::vector<bool> in_closed_loops(const std::vector<Joint>& joints, const std::vector<RigidBody>& bodies);

}  // namespace courant
