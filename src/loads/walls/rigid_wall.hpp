#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "loads/walls/wall_friction.hpp"
#include "loads/walls/wall_penalty.hpp"
#include "loads/walls/wall_shape.hpp"
#include "model/conditions/prescribed_motion.hpp"
#include "state/driven_points.hpp"
#include "state/points.hpp"
#include "state/world.hpp"

namespace courant {

/// A rigid wall: what it is made of, and how it moves.
struct RigidWallSetup {
  Id id = 0;
  std::string title;
  WallShape shape;
  Real birth = 0, death = 1e20;
  Real body_stiffness = 1;                   ///< RWKSF: share of the penalty for rigid bodies
  Real mass = 0;                             ///< 0: it does not yield. Of planes only
  Real speed = 0;                            ///< at the start, along the normal, of one with a mass [L/T]
  Real friction = 0;                         ///< infinite where nothing slides
  std::optional<OrthoFriction> ortho{};      ///< instead of that, where it differs by direction
  std::array<Index, 2> ortho_nodes{-1, -1};  ///< of World::nodes, between which d is; -1: d stays
  bool welds = false;                        ///< what comes faster than weld_speed [L/T]
  Real weld_speed = 0;
  std::optional<PrescribedMotion> motion{};  ///< of the whole wall, without turning
};

/// A set of points, and which of them a wall holds.
struct HeldPoints {
  Points points;
  Field<Index>& state;  ///< 0 not held, 1 held, 2 welded
  Field<Real>& push;    ///< force of the wall in this step [ML/T2]
  const Field<Index>* axes = nullptr;
  std::optional<DrivenPoints> driven{};
};

/// A wall and the points of all sets that it holds; each wall names the same sets in the same order.
struct RigidWallAndPoints {
  RigidWallSetup wall;
  std::vector<HeldPoints> sets;
  WallPenalty bodies{};
};

/// Adds the passes of all walls of a world.
void add_wall_passes(std::vector<RigidWallAndPoints> walls, World& world);

}  // namespace courant
