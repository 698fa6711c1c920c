#pragma once
// Properties of rigid bodies for contact, ties and springs.
#include <functional>
#include <vector>

#include "base/real.hpp"
#include "state/pass.hpp"

namespace courant {

struct WallBodies {
  std::vector<Index> of_node;  ///< body that a node of the world belongs to, -1: none; empty: no bodies
  /// Change of the velocity of position q of a body along n per impulse along n there: 0 where it is fixed or
  /// driven. [1/M]
  std::function<Real(Index body, const Vec& q, const Vec& n)> give;
  /// Velocity of position q by an impulse and its moment about q, without the joints of the body; at any
  /// time. [L/T]
  std::function<Vec(Index body, const Vec& q, const Vec& impulse, const Vec& moment)> answer_alone;
  Real give_alone(Index body, const Vec& q, const Vec& n) const {
    return n.dot(answer_alone(body, q, n, Vec::Zero()));
  }
  /// Change of the velocity of position q over the coming step, by all forces and drives known so far. [L/T]
  std::function<Vec(Index body, const Vec& q, const Clock& clock)> change;
  /// Adds a force at q to those on the body in the coming step, after forces were summed. [ML/T2]
  std::function<void(Index body, const Vec& q, const Vec& force)> push;

  /// Largest ratio of the kinetic energy of a body by the masses of its nodes to its own: above 1 where a
  /// small mass or inertia is given. [-]
  std::function<Real(Index body)> lighter;

  /// Change of the angular velocity of a body about an axis per moment about it. [1/ML2]
  std::function<Real(Index body, const Vec& axis)> turn;
  /// Gives the body of a node, at a position, the mass and inertia of nodes that are tied to its faces; false
  /// where its mass is given. [L], [M], [ML2]
  std::function<bool(Index node, const Vec& position, Real mass, Real inertia)> take_mass;

  Index body(Index node) const { return of_node.empty() ? -1 : of_node[static_cast<std::size_t>(node)]; }
};

}  // namespace courant
