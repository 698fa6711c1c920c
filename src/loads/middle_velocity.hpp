#pragma once
#include "state/driven_points.hpp"
#include "state/points.hpp"
#include "state/shared_fields.hpp"
#include "state/world.hpp"

namespace courant {

/// The part of forces across the directions in which prescribed motions drove points in the last step.
/// Damping has no other one, so that reactions of motions are those of the other forces.
class AcrossDrives {
 public:
  explicit AcrossDrives(const Points& points)
      : driven_(points.driven().find(*points.set)), projector_(points.driven_projector().find(*points.set)) {}
  bool any() const { return driven_ && projector_; }
  bool any(Index i) const { return any() && (*driven_)[i] != 0; }
  Vec operator()(Index i, const Vec& force) const {
    return any(i) ? Vec(force - driven_part(*projector_, i, force)) : force;
  }
  void declare(Accesses& a) const {
    if (driven_) a.reads(*driven_);
    if (projector_) a.reads(*projector_);
  }

 private:
  const Field<Index>* driven_;
  const Field<Real>* projector_;  ///< null: no prescribed motion
};

/// Mean of the velocities before and after the coming kick, with which forces do exactly the work that the
/// kinetic energy gains. Along the directions of prescribed motions the velocity after it is the prescribed
/// one.
class MiddleVelocity {
 public:
  MiddleVelocity(const Points& points, const Clock& clock)
      : points_(points),
        half_(0.5 * clock.dt_mean()),
        driven_(points.driven().find(*points.set)),
        projector_(points.driven_projector().find(*points.set)),
        change_(points.driven_change().find(*points.set)) {}
  Vec operator()(Index i) const {
    const Vec v = points_.v->vec(i), by_forces = points_.f->vec(i) * (half_ / (*points_.m)[i]);
    if (!driven_ || !projector_ || (*driven_)[i] == 0) return v + by_forces;
    return v + by_forces - driven_part(*projector_, i, by_forces) + 0.5 * change_->vec(i);
  }

 private:
  const Points& points_;
  Real half_;
  const Field<Index>* driven_;
  const Field<Real>*projector_, *change_;  ///< null: no prescribed motion
};

}  // namespace courant
