#pragma once
// What contact, ties and springs have to know of the rigid bodies that they act on.
#include <functional>
#include <vector>

#include "base/real.hpp"
#include "state/pass.hpp"

namespace courant {

struct WallBodies {
  std::vector<Index> of_node;  ///< body that a node of the world belongs to, -1: none; empty: no bodies
  /// By how much the velocity of position q of a body changes along n for an impulse along n there: 0 where
  /// it is held or driven. [1/M]
  std::function<Real(Index body, const Vec& q, const Vec& n)> give;
  /// Velocity of position q by an impulse and its moment about q, as if no joint held the body; at any time.
  /// [L/T]
  std::function<Vec(Index body, const Vec& q, const Vec& impulse, const Vec& moment)> answer_alone;
  Real give_alone(Index body, const Vec& q, const Vec& n) const {
    return n.dot(answer_alone(body, q, n, Vec::Zero()));
  }
  /// Change of the velocity of position q over the coming step, by all forces and drives known so far. [L/T]
  std::function<Vec(Index body, const Vec& q, const Clock& clock)> change;
  /// Adds a force at q to what moves the body in the coming step, after forces were summed. [ML/T2]
  std::function<void(Index body, const Vec& q, const Vec& force)> push;

  /// How much larger the kinetic energy of a body can be by the masses of its nodes than it is: above 1 where
  /// its mass or inertia is given, and small. [-]
  std::function<Real(Index body)> lighter;

  /// By how much the angular velocity of a body changes about an axis for a moment about it. [1/ML2]
  std::function<Real(Index body, const Vec& axis)> turn;
  /// Gives the body of a node, at a position, the mass and inertia of nodes that are tied to its faces; false
  /// where its mass is given. [L], [M], [ML2]
  std::function<bool(Index node, const Vec& position, Real mass, Real inertia)> take_mass;

  Index body(Index node) const { return of_node.empty() ? -1 : of_node[static_cast<std::size_t>(node)]; }
};

}  // namespace courant
