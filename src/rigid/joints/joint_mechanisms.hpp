#pragma once
#include <vector>

#include "rigid/joints/joint_rows.hpp"

namespace courant {

/// Groups of bodies that joints connect, not counting connections through fixed bodies. What holds or
/// drives a body counts as a joint to the ground.
class Mechanisms {
 public:
  Mechanisms(const std::vector<Joint>& joints, const std::vector<RigidBody>& bodies);
  /// Whether the mechanism of a joint has a closed loop: equations may say the same twice there, and
  /// contradict each other where positions and axes are a little off.
  bool closed(std::size_t joint) const;
  bool same(std::size_t one, std::size_t other) const { return of_joint_[one] == of_joint_[other]; }

 private:
  struct Group {
    int bodies = 0, connections = 0, to_ground = 0;
  };
  std::vector<std::size_t> of_joint_;  ///< the body by which its group is known
  std::vector<Group> groups_;          ///< by that body; empty for others
};

}  // namespace courant
