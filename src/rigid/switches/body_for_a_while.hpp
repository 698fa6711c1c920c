#pragma once
// Nodes that move as one body for some time of the run. They stay nodes that move by their forces: while they
// are a body, these forces are replaced by those that make the nodes move as one, once all forces at t^n and
// dt are known. So whatever pushes nodes, pushes the body.
#include "rigid/bodies/rigid.hpp"
#include "state/world.hpp"

namespace courant {

/// Rotations of nodes; null: there are none.
struct NodalTurns {
  explicit NodalTurns(const World& world);
  Field<Real>*moment, *omega;
  const Field<Real>* inertia;
  const Field<Index>* none;
  bool turns(Index n) const { return none && (*none)[n] == 0; }
};

struct BodyForAWhile {
  RigidBody b{};     ///< RigidBody::nodes are given, everything else follows
  Index active = 0;  ///< 1: the nodes are one body
  HalfStep next{};   ///< of the step to come
  BodyPose pose{};

  /// Momenta stay; what the nodes move against each other at t^n, half a step behind their velocities, is
  /// lost.
  void stiffen(World& world, const Clock& clock, const NodalTurns& turns);
  /// At t^n the nodes have the velocities of the body. False where they were no body.
  bool release(World& world, const Clock& clock, const NodalTurns& turns);
  /// Forces that take each node to its position in the body at the end of the step.
  void move(World& world, const Clock& clock, const NodalTurns& turns);
  /// After the step.
  void advance(const Clock& clock);
  void keep(Archive& archive);

 private:
  void complete();
  void sum_forces(const World& world, const NodalTurns& turns);
  void give_half_step(World& world, Real dt_old, const NodalTurns& turns);
};

}  // namespace courant
