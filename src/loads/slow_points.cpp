// Velocities of a relaxation, which lose a share in each step.
#include "loads/loads.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// v of the step before is multiplied before the kick, as LS-DYNA does, and before prescribed motions, which
/// give what they drive its own. (Accelerations that are prescribed in a relaxation are refused.)
class SlowPoints : public Drive {
 public:
  SlowPoints(Points points, Real factor) : points_(points), factor_(factor) {}
  std::string name() const override { return "relaxation of " + points_.name(); }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.updates(*points_.v);
    if (points_.follow) a.reads(*points_.follow);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index i = begin; i < end; ++i) {
      if (points_.follow && (*points_.follow)[i]) continue;
      for (int k = 0; k < 3; ++k) points_.v->data(k)[i] *= factor_;
    }
  }

 private:
  Points points_;
  Real factor_;
};

}  // namespace

std::shared_ptr<Drive> make_slow_points(Points points, Real factor) {
  return std::make_shared<SlowPoints>(points, factor);
}

}  // namespace courant
