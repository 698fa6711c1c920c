// A paddle that follows a curve, and that absorbs: the level in front of it less the level of the waves that
// it makes is a wave that comes back. The paddle gets the velocity at which that wave would pass through it:
//   dX/dt = dX0/dt + gain (eta0 - eta) - Xc/drift,  Xc = X - X0
// with the curve X0, its elevation eta0 and the measured elevation eta behind a filter of first order.
#include "waves/wave_maker.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/run_error.hpp"
#include "gauges/gauge.hpp"
#include "state/restartable.hpp"

namespace courant {

namespace {

Real value_of(const Curve& curve, Real t) {
  return curve.abscissa.empty() ? 0 : curve(t);
}

class WaveMaker : public Impact, public EnergyTerm, public Restartable, public MotionSource {
 public:
  WaveMaker(WaveMakerSettings settings, std::shared_ptr<RigidBodies> bodies, std::size_t body,
            KernelChoice kernel)
      : s_(std::move(settings)), bodies_(std::move(bodies)), body_(body), kernel_(kernel) {}
  std::string name() const override { return fmt::format("wave maker of part {}", s_.id); }

  /// The velocity of the coming step, so that the paddle is where it should be at its end.
  void strike(World& world, const Clock& clock) override {
    next_filtered_ = filtered_, next_correction_ = correction_;
    if (s_.gain > 0) correct(world, clock);
    const Real before = value_of(s_.displacement, 0), after = value_of(s_.displacement, clock.t + clock.dt);
    move_to(s_.sf * (after - before) + next_correction_, clock.dt);
  }
  /// The only call of a step that is certain to be followed by its motion.
  void record(World& world, const Clock&, EnergyLedger&) override {
    filtered_ = next_filtered_, correction_ = next_correction_;
    if (s_.gain == 0) return;
    Real& most = world.maxima[fmt::format("wave_maker_{}_correction", s_.id)];
    most = std::max(most, std::abs(correction_));
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

  Real velocity(int component) const override {
    return component < 3 ? v_[component] : omega_[component - 3];
  }
  void keep(Archive& archive) override {
    archive("filtered", filtered_);
    archive("correction", correction_);
  }

 private:
  const RigidBody& body() const { return bodies_->bodies()[body_]; }
  Real angle() const {
    const Eigen::Quaterniond& q = body().q;
    return 2 * std::atan2(q.vec().dot(s_.paddle.axis()), q.w());
  }
  /// Displacement at the still level. [L]
  Real displacement() const {
    return s_.paddle.kind == Paddle::Kind::flap ? s_.paddle.arm() * std::tan(angle())
                                                : (body().x - body().x0).dot(s_.paddle.along);
  }

  void move_to(Real X, Real dt) {
    const Paddle& p = s_.paddle;
    omega_ = Vec::Zero();
    Vec x = body().x0 + X * p.along;
    if (p.kind == Paddle::Kind::flap) {
      const Real turned = std::atan(X / p.arm());
      omega_ = (turned - angle()) / dt * p.axis();
      x = p.pivot() + Eigen::AngleAxisd(turned, p.axis()) * (body().x0 - p.pivot());
    }
    v_ = (x - body().x) / dt;
  }

  void correct(const World& world, const Clock& clock) {
    const Real missing = s_.sf * value_of(s_.elevation, clock.t) - elevation(world, clock);
    const Real share = s_.filter > 0 ? 1 - std::exp(-clock.dt / s_.filter) : 1;
    next_filtered_ = filtered_ + share * (missing - filtered_);
    const Real back = s_.drift > 0 ? correction_ / s_.drift : 0;
    next_correction_ = correction_ + clock.dt * (s_.gain * next_filtered_ - back);
    if (std::abs(next_correction_) > s_.most)
      throw RunError(
          fmt::format(
              "the wave maker of part {} is {:.4g} off its curve at time {:.6g}, more than XMAX {:.4g}",
              s_.id, std::abs(next_correction_), clock.t, s_.most),
          fmt::format("check D ({:.4g}) and LCETA, or let the drift go back by TDRIFT", s_.paddle.depth));
  }

  /// Measured, above the still level. [L]
  Real elevation(const World& world, const Clock& clock) const {
    constexpr Real above = 2.5;  // depths
    const Vec foot = s_.paddle.bed + (displacement() + s_.distance) * s_.paddle.along;
    const auto gauge = make_level_gauge({}, 0, {foot, foot + above * s_.paddle.depth * s_.paddle.up});
    const std::vector<RigidBodyMotion> none;
    const GaugeView view{world, kernel_, none};
    std::vector<std::vector<GaugeBox>> boxes(1);
    gauge->cover(view, boxes[0]);
    const std::vector<Real> level = gauge->measure(view, near_.find(view, std::move(boxes))[0]);
    if (level[0] == 0)
      throw RunError(fmt::format("there is no water {:.4g} in front of the wave maker of part {} at time "
                                 "{:.6g}, where it measures "
                                 "the level",
                                 s_.distance, s_.id, clock.t),
                     "the paddle has left the water, or DIST is too large");
    return level[1] - s_.paddle.depth;
  }

  WaveMakerSettings s_;
  std::shared_ptr<RigidBodies> bodies_;
  std::size_t body_;
  KernelChoice kernel_;
  mutable NearParticles near_;
  Real filtered_ = 0, correction_ = 0;            ///< at t^n [L]
  Real next_filtered_ = 0, next_correction_ = 0;  ///< at t^n+1 [L]
  Vec v_ = Vec::Zero(), omega_ = Vec::Zero();     ///< of the coming step [L/T], [1/T]
};

}  // namespace

// Integral of (z - hinge)/arm over the water that the flap moves.
Real Paddle::moved_depth() const {
  if (kind == Kind::piston) return depth;
  return hinge >= 0 ? 0.5 * arm() : 0.5 * depth * (depth - 2 * hinge) / arm();
}

Real Paddle::long_wave_gain(Real g) const {
  return std::sqrt(g * depth) / moved_depth();
}

std::shared_ptr<Pass> make_wave_maker(WaveMakerSettings settings, std::shared_ptr<RigidBodies> bodies,
                                      std::size_t body, KernelChoice kernel) {
  auto made = std::make_shared<WaveMaker>(std::move(settings), bodies, body, kernel);
  bodies->drive(body, *made);
  return made;
}

}  // namespace courant
