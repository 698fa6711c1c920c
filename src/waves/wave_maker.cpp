// A paddle that follows a curve, and that absorbs: the level in front of it less the level of the waves that
// it makes is a wave that comes back. The paddle gets the velocity at which that wave would pass through it:
//   dX/dt = dX0/dt + gain (eta0 - eta) - Xc/drift - R,  dR/dt = Xc/(2 drift^2),  Xc = X - X0
// with the curve X0, its elevation eta0 and the measured elevation eta behind a filter of first order. The
// integral R lets no constant difference of levels move the paddle: what acts on the waves is that of
// s^2/(s^2 + s/drift + 1/(2 drift^2)).
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
            KernelChoice kernel, std::shared_ptr<const Neighbours> neighbours)
      : s_(std::move(settings)),
        bodies_(std::move(bodies)),
        body_(body),
        kernel_(kernel),
        neighbours_(std::move(neighbours)) {}
  std::string name() const override { return fmt::format("wave maker of part {}", s_.id); }

  /// The velocity of the coming step, so that the paddle is where it should be at its end.
  void strike(World& world, const Clock& clock) override {
    next_filtered_ = filtered_, next_correction_ = correction_, next_return_ = return_,
    next_square_ = square_, next_excess_ = excess_;
    if (s_.gain > 0) correct(world, clock);
    const Real before = value_of(s_.displacement, 0), after = value_of(s_.displacement, clock.t + clock.dt);
    move_to(s_.sf * (after - before) + next_correction_, clock.dt);
  }
  /// The only call of a step that is certain to be followed by its motion.
  void record(World& world, const Clock&, EnergyLedger&) override {
    filtered_ = next_filtered_, correction_ = next_correction_, return_ = next_return_,
    square_ = next_square_, excess_ = next_excess_;
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
    archive("return", return_);
    archive("square", square_);
    archive("excess", excess_);
    archive("still", still_);
    archive("started", started_);
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

  /// What the first level lacks of D is an error of the gauge where it is less than its resolution.
  void take_still_level(const World& world, Real elevation) {
    constexpr Real resolution = 0.1;  // spacings
    const Particles& p = world.particles;
    const Real V = p.m[0] / p.rho[0], spacing = world.dim == 2 ? std::sqrt(V) : std::cbrt(V);
    started_ = 1;
    still_ = std::abs(elevation) < resolution * spacing ? elevation : 0;
  }
  /// Of the displacement. [L/T]
  Real velocity_at_level() const {
    if (s_.paddle.kind == Paddle::Kind::piston) return body().v.dot(s_.paddle.along);
    const Real c = std::cos(angle());
    return s_.paddle.arm() * body().omega.dot(s_.paddle.axis()) / (c * c);
  }
  Real curve_speed(const Clock& clock) const {
    const Real before = value_of(s_.displacement, clock.t),
               after = value_of(s_.displacement, clock.t + clock.dt);
    return s_.sf * (after - before) / clock.dt;
  }
  void correct(const World& world, const Clock& clock) {
    const Real own = s_.sf * value_of(s_.elevation, clock.t), measured = elevation(world, clock);
    if (!started_) take_still_level(world, measured - own);
    // beside a moving paddle the level is that at rest plus X deta/dx, with deta/dx = -X''/g at the surface,
    // whose mean is X'^2/g; that of the absorption comes late, so that it does not act on itself
    const Real missing = own - (measured - still_ - (square_ + excess_) / s_.g);
    if (s_.drift > 0) {
      const Real speed = curve_speed(clock), now = velocity_at_level(), so_far = std::min(clock.t, s_.drift);
      next_square_ = square_ + clock.dt / (clock.dt + so_far) * (speed * speed - square_);
      next_excess_ = excess_ + clock.dt / (clock.dt + s_.drift) * (now * now - speed * speed - excess_);
    }
    const Real share = s_.filter > 0 ? 1 - std::exp(-clock.dt / s_.filter) : 1;
    next_filtered_ = filtered_ + share * (missing - filtered_);
    const Real back = s_.drift > 0 ? correction_ / s_.drift + return_ : 0;
    next_correction_ = correction_ + clock.dt * (s_.gain * next_filtered_ - back);
    if (s_.drift > 0) next_return_ = return_ + clock.dt * next_correction_ / (2 * s_.drift * s_.drift);
    if (std::abs(next_correction_) > s_.most)
      throw RunError(
          fmt::format(
              "the wave maker of part {} is {:.4g} off its curve at time {:.6g}, more than XMAX {:.4g}",
              s_.id, std::abs(next_correction_), clock.t, s_.most),
          fmt::format("check D ({:.4g}) and LCETA, or let the drift go back by TDRIFT", s_.paddle.depth));
  }

  /// The line on which the level is measured: at `distance` from the paddle and parallel to it, so that the
  /// paddle cuts the kernel alike all along.
  GaugeLine line() const {
    constexpr Real above = 1.5;  // depths over the still level
    const Paddle& p = s_.paddle;
    const Vec still = p.bed + displacement() * p.along + p.depth * p.up;
    const Real c = std::cos(angle()), s = std::sin(angle());
    const Vec upwards = c * p.up + s * p.along, at = still + s_.distance * (c * p.along - s * p.up);
    return {at - p.depth / c * upwards, at + above * p.depth / c * upwards};
  }
  /// Measured, above the still level. [L]
  Real elevation(const World& world, const Clock& clock) const {
    const auto gauge = make_level_gauge({}, 0, line());
    const std::vector<RigidBodyMotion> none;
    const GaugeView view{world, kernel_, none};
    std::vector<GaugeBox> boxes;
    gauge->cover(view, boxes);
    const std::vector<Real> level = gauge->measure(view, particles_near(view, *neighbours_, boxes));
    if (level[0] == 0)
      throw RunError(fmt::format("there is no water {:.4g} in front of the wave maker of part {} at time "
                                 "{:.6g}, where it measures "
                                 "the level",
                                 s_.distance, s_.id, clock.t),
                     "the paddle has left the water, or DIST is too large");
    return (Vec(level[2], level[3], level[4]) - s_.paddle.bed).dot(s_.paddle.up) - s_.paddle.depth;
  }

  WaveMakerSettings s_;
  std::shared_ptr<RigidBodies> bodies_;
  std::size_t body_;
  KernelChoice kernel_;
  std::shared_ptr<const Neighbours> neighbours_;
  Real filtered_ = 0, correction_ = 0;            ///< at t^n [L]
  Real next_filtered_ = 0, next_correction_ = 0;  ///< at t^n+1 [L]
  Real return_ = 0, next_return_ = 0;             ///< velocity back to the curve, at t^n and t^n+1 [L/T]
  Real excess_ = 0, next_excess_ = 0;             ///< mean of X'^2 - X0'^2 [L2/T2]
  Real square_ = 0, next_square_ = 0;             ///< mean of X0'^2 over `drift` [L2/T2]
  Real still_ = 0;                                ///< elevation of still water as the gauge has it [L]
  std::int64_t started_ = 0;                      ///< whether `still_` is known
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
                                      std::size_t body, KernelChoice kernel,
                                      std::shared_ptr<const Neighbours> neighbours) {
  auto made = std::make_shared<WaveMaker>(std::move(settings), bodies, body, kernel, std::move(neighbours));
  bodies->drive(body, *made);
  return made;
}

}  // namespace courant
