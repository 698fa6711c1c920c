#pragma once
// Changes by a program during the run: forces on points, and their velocities.
#include <memory>
#include <string>

#include "state/points.hpp"
#include "state/world.hpp"

namespace courant {

/// Forces on particles or nodes, each until it is changed, and velocities. The work of both is work from
/// outside.
class PointChanges {
 public:
  virtual ~PointChanges() = default;
  /// Why nothing of a point can be changed: a body moves it, or it is outside of the box. Empty: it can.
  virtual std::string why_not(const World& world, Index i) const = 0;
  /// From the next step on. [ML/T2]
  virtual void set_force(Index i, const Vec& force) = 0;
  /// At a time level; along axes that are held it stays 0. Returns why not, empty where it is done. [L/T]
  virtual std::string set_velocity(World& world, Index i, const Vec& v) = 0;
};

/// Null where there are no such points, or the deck lacks *COURANT_PROGRAM_FORCES.
struct ProgramForces {
  std::shared_ptr<PointChanges> on_particles, on_nodes;
};

}  // namespace courant
