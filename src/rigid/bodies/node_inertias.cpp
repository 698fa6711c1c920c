#include "rigid/bodies/node_inertias.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace courant {

namespace {

Matrix inertia_of_moments(const Matrix& second) {
  return second.trace() * Matrix::Identity() - second;
}

/// A mass at `place` that moves with v is at position + d, and moves with v + omega x d.
void shift_mass(Real mass, const Vec& place, const Vec& velocity, const Vec& d, const Vec& omega,
                RigidBody& b) {
  const Vec r = place - b.x, far = r + d, faster = velocity + omega.cross(d);
  const Vec centre = mass / b.m * d;  // from the old one
  const Matrix second =
      mass * (far * far.transpose() - r * r.transpose()) - b.m * centre * centre.transpose();
  b.J0 += inertia_of_moments(second);
  b.v += mass / b.m * (faster - velocity);
  b.L += mass * (far.cross(faster) - r.cross(velocity)) - b.m * centre.cross(b.v);
  b.x += centre;
}

}  // namespace

bool add_node_inertias(const Deck& deck, const Model& model, const std::map<Id, Index>& world_node,
                       const World& world, RigidBody& b, Diagnostics& diagnostics) {
  for (const ModelInertia& one : model.inertias) {
    const auto in_world = world_node.find(model.nodes[static_cast<std::size_t>(one.node)].id);
    const auto is_it = [&](Index n) { return n == in_world->second; };
    if (in_world == world_node.end() || std::none_of(b.nodes.begin(), b.nodes.end(), is_it)) continue;
    if (std::any_of(b.unweighed.begin(), b.unweighed.end(), is_it)) {
      deck.error(
          diagnostics, one.card, "NID",
          fmt::format("node {} belongs to {}, whose inertia is given by a card", in_world->first, b.name),
          "add mass and inertia to those of that card, by hand");
      return false;
    }
    constexpr Real small = 1e-12;
    Vec omega = Vec::Zero();
    if (b.J0.determinant() > small * std::pow(b.J0.trace(), 3))
      omega = b.J0.inverse() * b.L;
    else if (const auto given = model.angular_velocity.find(one.node); given != model.angular_velocity.end())
      omega = given->second;
    const Index n = in_world->second;
    if (one.mass > 0 && one.offset.norm() > 0)
      shift_mass(one.mass, world.nodes.x.vec(n), world.nodes.v.vec(n), one.offset, omega, b);
    b.J0 += one.J;
    b.L += one.J * omega;
  }
  return true;
}

}  // namespace courant
