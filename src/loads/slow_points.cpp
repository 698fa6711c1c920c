// Velocities of a relaxation, which lose a share in each step.
#include "loads/loads.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// v of the step before is multiplied before the kick, as LS-DYNA does. What prescribed motions drive keeps
/// its own.
class SlowPoints : public Drive {
 public:
  SlowPoints(Points points, Real factor)
      : points_(points), factor_(factor), driven_(points.driven().find(*points.set)) {}
  std::string name() const override { return "relaxation of " + points_.name(); }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.updates(*points_.v);
    if (points_.follow) a.reads(*points_.follow);
    if (driven_) a.reads(*driven_);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index i = begin; i < end; ++i) {
      if ((points_.follow && (*points_.follow)[i]) || (driven_ && (*driven_)[i] != 0)) continue;
      for (int k = 0; k < 3; ++k) points_.v->data(k)[i] *= factor_;
    }
  }

 private:
  Points points_;
  Real factor_;
  const Field<Index>* driven_;  ///< null: there are none
};

}  // namespace

std::shared_ptr<Drive> make_slow_points(Points points, Real factor) {
  return std::make_shared<SlowPoints>(points, factor);
}

}  // namespace courant
