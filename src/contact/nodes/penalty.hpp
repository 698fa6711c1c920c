#pragma once
// What penalties between nodes, faces and edges share: their force within a step, friction, the step.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "contact/nodes/law.hpp"
#include "state/driven_points.hpp"
#include "state/restartable.hpp"
#include "state/wall_bodies.hpp"
#include "state/world.hpp"

namespace courant {

/// Of a spring's force where the surface lies within the last step, or within the next: the impulses of a
/// step are no longer those of the depth in its middle, and a bounce would return 1 +- (omega dt)^2/4 of
/// its energy, by chance. With this factor the sums of leapfrog, v^2 + omega^2 d_n d_n+1, stay what they are
/// outside, v^2. `speed`: out of the surface, in the half step before [L/T]; omega2: of the spring, with what
/// acts beside it [1/T2]. [-]
inline Real part_of_step(Real depth, Real speed, Real dt, Real omega2) {
  const Real theta = std::min(omega2 * dt * dt, Real(1)), before = std::abs(speed) * dt;
  const bool comes = speed < 0 && before > depth, goes = speed > 0 && before + theta * depth > depth;
  if (!comes && !goes) return 1;
  const Real after =
      comes ? 0.5 * (std::sqrt(theta * depth * (theta * depth - 4 * depth) + 4 * before * before) -
                     theta * depth)
            : std::sqrt(before * before + theta * depth * (depth + before));
  return (depth + (comes ? after : before)) / (before + after);
}

/// Elastic predictor: the spring of the last step, turned into the tangent plane of n, plus -k times the slip
/// at velocity `v` since then; at most what FS, FD and VC allow of `fn`. [ML/T2]
Vec friction_of(const Friction& mu, const Vec& old, const Vec& n, const Vec& v, Real k_dt, Real fn,
                Real area);

/// Bound of a frequency, and of which node.
struct ContactFrequency {
  Real omega2 = 0;  ///< squared [1/T2]
  Index node = -1;  ///< of World::nodes
};
struct StiffestContact {
  ContactFrequency now, soon;  ///< by what is in touch; with what will be
  void take(const StiffestContact& other) {
    if (other.now.omega2 > now.omega2) now = other.now;
    if (other.soon.omega2 > soon.omega2) soon = other.soon;
  }
};
/// The step that it allows; `due`: until the next touch [T]; `part`: of what elements leave, where others ask
/// for the rest [-].
TimeLimit::Limit limit_of(const NodeContactLaw& law, const StiffestContact& stiffest, Real due, Real part,
                          const std::string& name, const World& world);

/// Mean over the step about to be taken. [L/T]
Vec middle_velocity(const World& world, const WallBodies& bodies, const Clock& clock,
                    const DrivenPoints& driven, Index node);

}  // namespace courant
