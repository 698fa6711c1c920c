#pragma once
#include "state/points.hpp"
#include "state/shared_fields.hpp"
#include "state/world.hpp"

namespace courant {

/// Mean of the velocities before and after the kick to come, with which forces do exactly the work that the
/// kinetic energy gains. Of points whose motion is prescribed, that before: they do not follow their forces.
class MiddleVelocity {
 public:
  MiddleVelocity(const Points& points, const Clock& clock)
      : points_(points), half_(0.5 * clock.dt_mean()), driven_(points.driven().find(*points.set)) {}
  Vec operator()(Index i) const {
    const Vec v = points_.v->vec(i);
    if (driven_ && (*driven_)[i] != 0) return v;
    return v + points_.f->vec(i) * (half_ / (*points_.m)[i]);
  }

 private:
  const Points& points_;
  Real half_;
  const Field<Index>* driven_;
};

}  // namespace courant
