#pragma once
#include "state/access.hpp"
#include "state/points.hpp"
#include "state/shared_fields.hpp"

namespace courant {

/// Points with prescribed motions: the directions in which these act, and the velocities that they prescribe.
/// In a step they are known once its size is; before that they are those of the last step. Without a pass
/// that states them, all directions are driven, and velocities stay.
class DrivenPoints {
 public:
  explicit DrivenPoints(const Points& points)
      : DrivenPoints(points.fields(), points.driven(), points.driven_projector(), points.driven_change()) {}
  /// Of positions of particles or nodes.
  explicit DrivenPoints(const FieldSet& fields)
      : DrivenPoints(fields, shared_fields::prescribed_motion, shared_fields::driven_projector,
                     shared_fields::driven_change) {}
  bool any() const { return driven_ != nullptr; }
  bool any(Index i) const { return driven_ && (*driven_)[i] != 0; }
  /// The part of a vector along the driven directions of a driven point.
  Vec along(Index i, const Vec& a) const {
    if (!projector_) return a;
    const auto P = [&](int k) { return projector_->data(k)[i]; };
    return {P(0) * a[0] + P(3) * a[1] + P(5) * a[2], P(3) * a[0] + P(1) * a[1] + P(4) * a[2],
            P(5) * a[0] + P(4) * a[1] + P(2) * a[2]};
  }
  /// The part across them; of other points all.
  Vec across(Index i, const Vec& a) const { return any(i) ? Vec(a - along(i, a)) : a; }
  /// Velocity after a part of the coming kick, in which forces alone would change v by `by_forces`. [L/T]
  Vec velocity_after(Index i, const Vec& v, const Vec& by_forces, Real part) const {
    if (!any(i)) return v + by_forces;
    return projector_ ? Vec(v + by_forces - along(i, by_forces) + part * change_->vec(i)) : v;
  }
  /// For passes that ask for directions alone.
  void declare(Accesses& a) const {
    if (driven_) a.reads(*driven_);
    if (projector_) a.reads(*projector_);
  }

 private:
  DrivenPoints(const FieldSet& fields, const SharedField<Index>& driven, const SharedField<Real>& projector,
               const SharedField<Real>& change)
      : driven_(driven.find(fields)), projector_(projector.find(fields)), change_(change.find(fields)) {}
  const Field<Index>* driven_;
  const Field<Real>*projector_, *change_;  ///< null: no prescribed motion
};

}  // namespace courant
