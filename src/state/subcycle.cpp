#include "state/subcycle.hpp"

#include <algorithm>

namespace courant {

namespace {

/// A pass at the time of outer steps.
class SlowPass : public BlockPass {
 public:
  SlowPass(BlockPass& pass, const Subcycle& subcycle) : pass_(pass), subcycle_(subcycle) {}
  std::string name() const override { return pass_.name(); }
  Phase phase() const override { return pass_.phase(); }
  const FieldSet& over(const World& world) const override { return pass_.over(world); }
  void declare(const World& world, Accesses& accesses) const override { pass_.declare(world, accesses); }
  void start(World& world, const Clock&) override { pass_.start(world, subcycle_.slow()); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    pass_.block(world, subcycle_.slow(), begin, end);
  }
  void finish(World& world, const Clock&) override { pass_.finish(world, subcycle_.slow()); }

 private:
  BlockPass& pass_;
  const Subcycle& subcycle_;
};

}  // namespace

void Subcycle::add_slow(BlockPass& pass) {
  slow_passes_.emplace(&pass, std::make_unique<SlowPass>(pass, *this));
}

Subcycle* Subcycle::of(const World& world) {
  const std::vector<Subcycle*> all = world.passes.all<Subcycle>();
  return all.empty() ? nullptr : all.front();
}

int Subcycle::steps_at(Real dt) const {
  constexpr Real round_off = 1e-9;
  const Real ratio = std::min(longest() / dt * (1 + round_off), Real(most_));
  return std::max(1, static_cast<int>(ratio));
}

// One step more only with some reserve, so that the number does not swing with the limits.
bool Subcycle::begin(const Clock& clock) {
  if (!(clock.dt_old > 0)) ahead_ = 0;  // forces of the start may be asked for several times
  lag_ = -ahead_;
  if (!outer_) return false;
  slow_ = clock, slow_.dt_old = elapsed_;
  single_ = taken_ <= 1;
  const Real dt = clock.dt_old;
  const int before = n_;
  if (dt > 0) n_ = std::min(steps_at(dt), std::max(n_, steps_at(dt / reserve)));
  plain_ = !(dt > 0) || (single_ && before == 1 && n_ == 1);
  weight_ = plain_ ? 1 : std::max(Real(0), (0.5 * n_ * dt - ahead_) / dt);
  return true;
}

void Subcycle::chosen(const Clock& clock, Real limit, Real between) {
  limit_ = limit, between_ = between;
  n_ = std::min(n_, steps_at(clock.dt));
  planned_ = n_ * clock.dt;
  const Real kick = weight_ * clock.dt_mean();
  slow_.dt = plain_ ? clock.dt : 2 * kick - elapsed_;
  ahead_ = plain_ ? 0.5 * clock.dt : ahead_ + kick;
  elapsed_ = 0, taken_ = 0;
}

void Subcycle::end(const Clock& clock) {
  ahead_ -= clock.dt, elapsed_ += clock.dt, ++taken_;
  outer_ = !(elapsed_ + 0.5 * clock.dt < planned_ && elapsed_ + clock.dt <= overrun * longest());
}

void Subcycle::keep(Archive& archive) {
  archive("outer", outer_);
  archive("steps", n_);
  archive("taken", taken_);
  archive("elapsed", elapsed_);
  archive("planned", planned_);
  archive("ahead", ahead_);
  archive("limit", limit_);
  archive("between", between_);
}

}  // namespace courant
