#pragma once
#include "state/driven_points.hpp"
#include "state/points.hpp"
#include "state/world.hpp"

namespace courant {

/// Mean of the velocities before and after the coming kick, with which forces do exactly the work that the
/// kinetic energy gains. Along the directions of prescribed motions the velocity after it is the prescribed
/// one.
class MiddleVelocity {
 public:
  MiddleVelocity(const Points& points, const Clock& clock)
      : points_(points), half_(0.5 * clock.dt_mean()), driven_(points) {}
  Vec operator()(Index i) const {
    return driven_.velocity_after(i, points_.v->vec(i), points_.f->vec(i) * (half_ / (*points_.m)[i]), 0.5);
  }

 private:
  const Points& points_;
  Real half_;
  DrivenPoints driven_;
};

}  // namespace courant
