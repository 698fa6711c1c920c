// Velocities at the start of bodies in joints, and joints that do not fit together.
#include "rigid/joints/joint_mechanisms.hpp"
#include "rigid/joints/joints.hpp"

namespace courant {

namespace {

/// What a row adds to others below which it almost follows from them, of what free bodies would give: axes
/// that are askew by 0.03.
constexpr Real almost_follows = 1e-3;

}  // namespace

std::vector<std::size_t> Joints::find_misfits() const {
  const Mechanisms mechanisms(joints_, bodies_->bodies());
  std::vector<std::size_t> out;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (!mechanisms.closed(j) || !can_yield(joints_[j])) continue;
    bool almost = false;
    for (Index k = first_row_[j]; k < first_row_[j + 1]; ++k)
      almost = almost || (!matrix_.left_out(k) && matrix_.pivot(k) < almost_follows * free_[k]);
    if (almost) out.push_back(j);
  }
  return out;
}

void Joints::soften(std::size_t at) {
  const Mechanisms mechanisms(joints_, bodies_->bodies());
  for (std::size_t j = 0; j < joints_.size(); ++j)
    if (mechanisms.same(j, at)) joints_[j].yields = joints_[j].yields || can_yield(joints_[j]);
}

void Joints::start_drives(const Clock& clock, World& world) {
  for (std::size_t k = 0; k < joined_.size(); ++k) {
    const RigidBody& b = bodies_->bodies()[k];
    if (!tied(k)) continue;
    for (const PrescribedMotion& motion : b.motions) {
      if (!motion.drives(clock.t, clock.dt)) continue;
      const Vec d = b.direction_of(motion, b.q);
      const Real now = (motion.turns ? b.omega : b.v).dot(d);
      const Vec change = (motion.velocity(clock.t, clock.dt, 0, now) - now) * d;
      if (motion.turns)
        bodies_->strike_at_start(k, Vec::Zero(), b.J0 * change, world);
      else
        bodies_->strike_at_start(k, b.m * change, Vec::Zero(), world);
    }
  }
}

Joints::Start Joints::make_start_consistent(World& world) {
  Clock clock;
  clock.dt = 1e-9;  // for velocities of curves where they begin
  start_drives(clock, world);
  Start out{bodies_->kinetic_energy(), 0, 0};
  const std::vector<JointRow> rows = rows_at(poses_now());
  factorise(rows, &clock, follows_from_others);
  if (!exact_) out.misfits = find_misfits();
  for (const std::size_t joint : out.misfits) soften(joint);
  if (!out.misfits.empty()) factorise(rows, &clock, almost_follows);
  constexpr int rounds = 2;  // the later one for round-off
  Real worst = 0;
  std::vector<Real> wanted(static_cast<std::size_t>(first_row_.back()), 0);
  for (int round = 0; round < rounds; ++round) {
    Eigen::VectorXd rate(first_row_.back());
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const RigidBody &a = bodies_->bodies()[joints_[j].a], &b = bodies_->bodies()[joints_[j].b];
      for (Index k = first_row_[j]; k < first_row_[j + 1]; ++k) {
        const auto i = static_cast<std::size_t>(k);
        rate[k] = rate_of(rows[i], a, b);
        if (round == 0 && is_motor(joints_[j].kind)) wanted[i] = start_rate_of(joints_[j], rate[k], clock);
        rate[k] -= wanted[i];
        const Real energy = free_[k] > 0 ? rate[k] * rate[k] / free_[k] : 0;
        if (round == 0 && energy > worst) worst = energy, out.worst = j;
      }
    }
    const auto impulse = on_bodies(rows, -matrix_.solve(rate));
    for (std::size_t k = 0; k < impulse.size(); ++k)
      if (tied(k)) {
        const Inverse& free = inverse_[k];  // what is driven is not struck
        const RigidBody& b = bodies_->bodies()[k];
        const Matrix R = b.q.toRotationMatrix();
        bodies_->strike_at_start(k, b.m * (free.mass * impulse[k][0]),
                                 R * b.J0 * R.transpose() * (free.inertia * impulse[k][1]), world);
      }
  }
  out.after = bodies_->kinetic_energy();
  return out;
}

Real Joints::start_rate_of(Joint& joint, Real now, const Clock& clock) const {
  JointDrive& drive = joint.drive;
  switch (drive.kind) {
    case PrescribedMotion::Kind::velocity:
      return drive.sense * drive.curve(0);
    case PrescribedMotion::Kind::displacement:
      return drive.over(0, clock.dt) / clock.dt;
    case PrescribedMotion::Kind::acceleration:
      return drive.start_rate = now;
  }
  return now;
}

}  // namespace courant
