#include "rigid/joints/joint_mechanisms.hpp"

#include <algorithm>
#include <numeric>

namespace courant {

namespace {

class Mechanisms {
 public:
  explicit Mechanisms(std::size_t bodies) : parent_(bodies), closed_(bodies, false) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t body) const {
    while (parent_[body] != body) body = parent_[body];
    return body;
  }
  void connect(std::size_t a, std::size_t b) {
    const std::size_t first = of(a), second = of(b);
    if (first == second) {
      closed_[first] = true;
      return;
    }
    parent_[second] = first;
    closed_[first] = closed_[first] || closed_[second];
  }
  bool closed(std::size_t body) const { return closed_[of(body)]; }

 private:
  std::vector<std::size_t> parent_;
  std::vector<bool> closed_;
};

bool is_set(const std::array<bool, 3>& flags) {
  return std::find(flags.begin(), flags.end(), true) != flags.end();
}

}  // namespace

std::vector<bool> in_closed_loops(const std::vector<Joint>& joints, const std::vector<RigidBody>& bodies) {
  const std::size_t ground = bodies.size();
  Mechanisms mechanisms(bodies.size() + 1);
  const auto place = [&](std::size_t body) { return bodies[body].fixed() ? ground : body; };
  for (const Joint& joint : joints) mechanisms.connect(place(joint.a), place(joint.b));
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (!bodies[b].fixed() &&
        (is_set(bodies[b].held) || is_set(bodies[b].no_turn) || !bodies[b].motions.empty()))
      mechanisms.connect(b, ground);
  std::vector<bool> out;
  for (const Joint& joint : joints)
    out.push_back(mechanisms.closed(place(bodies[joint.a].fixed() ? joint.b : joint.a)));
  return out;
}

}  // namespace courant
