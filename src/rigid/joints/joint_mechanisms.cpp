#include "rigid/joints/joint_mechanisms.hpp"

#include <algorithm>
#include <numeric>

namespace courant {

namespace {

bool is_set(const std::array<bool, 3>& flags) {
  return std::find(flags.begin(), flags.end(), true) != flags.end();
}

}  // namespace

Mechanisms::Mechanisms(const std::vector<Joint>& joints, const std::vector<RigidBody>& bodies)
    : groups_(bodies.size()) {
  std::vector<std::size_t> parent(bodies.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t body) {
    while (parent[body] != body) body = parent[body];
    return body;
  };
  for (const Joint& joint : joints)
    if (!bodies[joint.a].fixed() && !bodies[joint.b].fixed()) parent[root(joint.b)] = root(joint.a);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].fixed()) continue;
    Group& group = groups_[root(b)];
    ++group.bodies;
    if (is_set(bodies[b].held) || is_set(bodies[b].no_turn) || !bodies[b].motions.empty())
      ++group.connections, ++group.to_ground;
  }
  for (const Joint& joint : joints) {
    of_joint_.push_back(root(bodies[joint.a].fixed() ? joint.b : joint.a));
    Group& group = groups_[of_joint_.back()];
    ++group.connections;
    if (bodies[joint.a].fixed() || bodies[joint.b].fixed()) ++group.to_ground;
  }
}

// A tree has a connection less than it has bodies; the ground is one more.
bool Mechanisms::closed(std::size_t joint) const {
  const Group& group = groups_[of_joint_[joint]];
  return group.connections > group.bodies - (group.to_ground > 0 ? 0 : 1);
}

}  // namespace courant
