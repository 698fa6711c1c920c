#pragma once
// What penalties between nodes, faces and edges share: their force within a step, friction, the step.
#include <limits>
#include <string>

#include "contact/nodes/law.hpp"
#include "state/restartable.hpp"
#include "state/wall_bodies.hpp"
#include "state/world.hpp"

namespace courant {

/// Of a spring's force where the surface lies within the last step, or within the next: the impulses of a
/// step are no longer those of the depth in its middle, and a bounce would give back 1 +- (omega dt)^2/4 of
/// its energy, by chance. With this factor the sums of leapfrog, v^2 + omega^2 d_n d_n+1, close to first
/// order in how far the surface is from a sample. `way`: of a step, at most. [-]
inline Real part_of_step(Real depth, Real way) {
  return way > depth ? 0.5 * (1 + depth / way) : Real(1);
}

/// Elastic predictor: the spring of the last step, turned into the tangent plane of n, plus -k times the slip
/// at velocity `v` since then; at most what FS, FD and VC allow of `fn`. [ML/T2]
Vec friction_of(const NodeContactLaw& law, const Vec& old, const Vec& n, const Vec& v, Real k_dt, Real fn,
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

/// Mean over the step about to be taken; of driven nodes, which do not follow their forces, that before.
/// [L/T]
Vec middle_velocity(const World& world, const WallBodies& bodies, const Clock& clock,
                    const Field<Index>* driven, Index node);

}  // namespace courant
