// What resists the turning of two rigid bodies against each other.
#include "rigid/joints/joint_stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/run_error.hpp"
#include "rigid/joints/joint_stiffness_pass.hpp"

namespace courant {

namespace {

Real next_to(Real angle, Real near) {
  return angle + 2 * pi * std::round((near - angle) / (2 * pi));
}

/// The steepest slope of a curve.
Real steepest(const Curve& curve) {
  Real out = 0;
  for (std::size_t k = 1; k < curve.abscissa.size(); ++k)
    out = std::max(out, std::abs((curve.ordinate[k] - curve.ordinate[k - 1]) /
                                 (curve.abscissa[k] - curve.abscissa[k - 1])));
  return out;
}

Real beyond_stops(const AngleResistance& r, Real angle) {
  if (r.high > 0 && angle > r.high) return angle - r.high;
  if (r.low < 0 && angle < r.low) return angle - r.low;
  return 0;
}

}  // namespace

// R = R_A^T R_B = R_x(phi) R_y(theta) R_z(psi). Of the two sets of angles that give it the one next to the
// last step's is taken.
JointAngles angles_of(const JointStiffness& joint, const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Matrix A = a.toRotationMatrix() * joint.axes_a, B = b.toRotationMatrix() * joint.axes_b;
  const Matrix R = A.transpose() * B;
  const Real theta = std::asin(std::clamp(R(0, 2), Real(-1), Real(1)));
  const Real phi = std::atan2(-R(1, 2), R(2, 2)), psi = std::atan2(-R(0, 1), R(0, 0));
  const auto near = [&](std::size_t k, Real angle) { return next_to(angle, joint.about[k].angle); };
  const std::array<std::array<Real, 3>, 2> both{
      {{near(0, phi), near(1, theta), near(2, psi)},
       {near(0, phi + pi), near(1, pi - theta), near(2, psi + pi)}}};
  const auto change = [&](const std::array<Real, 3>& angle) {
    Real sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += std::abs(angle[k] - joint.about[k].angle);
    return sum;
  };
  JointAngles out;
  out.angle = change(both[0]) <= change(both[1]) ? both[0] : both[1];
  const Vec first = A.col(0), third = B.col(2),
            second = A * Vec(0, std::cos(out.angle[0]), std::sin(out.angle[0]));
  out.cosine = std::cos(out.angle[1]);
  out.axis = {Vec(second.cross(third) / out.cosine), second, Vec(first.cross(second) / out.cosine)};
  return out;
}

void JointStiffnesses::strike(World&, const Clock& clock) {
  slipped_ = 0;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointStiffness& joint = joints_[j];
    const RigidBody &a = bodies_->bodies()[joint.a], &b = bodies_->bodies()[joint.b];
    const JointAngles now = angles_of(joint, a.q, b.q);
    moment_[j].setZero(), damping_[j].setZero();
    for (std::size_t k = 0; k < 3; ++k) {
      AngleResistance& r = joint.about[k];
      const Real angle = now.angle[k];
      if (r.friction > 0) {
        const Real trial = r.moment + r.elastic * (angle - r.angle);
        const Real moment = std::clamp(trial, -r.friction, r.friction);
        slipped_ += (trial - moment) / r.elastic * moment;
        r.moment = moment;
      }
      r.angle = angle;
      Real moment = r.moment + r.elastic * beyond_stops(r, angle);
      if (!r.stiffness.abscissa.empty()) moment += r.stiffness(angle);
      const Real rate = now.axis[k].dot(b.omega - a.omega);
      const Real damping = r.damping.abscissa.empty() ? 0 : r.damping(rate);
      constexpr Real level = 1e-3;
      if (k != 1 && std::abs(now.cosine) < level && (moment != 0 || damping != 0))
        throw RunError(
            fmt::format("t = {:g}: joint stiffness {}: at THETA = 90 degrees its other two angles are "
                        "not defined",
                        clock.t, joint.id),
            "choose other axes");
      if (moment != 0) moment_[j] += moment * now.axis[k];
      if (damping != 0) damping_[j] += damping * now.axis[k];
    }
    const Vec all = moment_[j] + damping_[j];
    bodies_->push(joint.a, Vec::Zero(), all);
    bodies_->push(joint.b, Vec::Zero(), Vec(-all));
  }
}

void JointStiffnesses::record(World&, const Clock& clock, EnergyLedger& ledger) {
  Real lost = slipped_;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (damping_[j].isZero(0)) continue;
    const auto middle = [&](const RigidBody& b) -> Vec {
      return b.fixed() ? b.omega : Vec(b.omega + 0.5 * b.turning_by(next_half_step(b, clock).L - b.L, b.q));
    };
    lost += clock.dt_mean() * damping_[j].dot(middle(bodies_->bodies()[joints_[j].b]) -
                                              middle(bodies_->bodies()[joints_[j].a]));
  }
  ledger.dissipated += lost, ledger.throughput += std::abs(lost);
}

void JointStiffnesses::sample(const World&, const Clock&, EnergyLedger& ledger) const {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    for (const AngleResistance& r : joints_[j].about) {
      const Real beyond = beyond_stops(r, r.angle);
      ledger.internal += 0.5 * r.elastic * beyond * beyond;
      if (r.friction > 0) ledger.internal += 0.5 * r.moment * r.moment / r.elastic;
      if (r.stiffness.abscissa.empty()) continue;
      ledger.internal +=
          r.angle >= 0 ? integral(r.stiffness, 0, r.angle) : -integral(r.stiffness, r.angle, 0);
    }
  }
}

TimeLimit::Limit JointStiffnesses::limit(const World&, const Clock&) {
  Limit out{std::numeric_limits<Real>::infinity(), ""};
  for (const JointStiffness& joint : joints_) {
    const RigidBody &a = bodies_->bodies()[joint.a], &b = bodies_->bodies()[joint.b];
    const JointAngles now = angles_of(joint, a.q, b.q);
    for (std::size_t k = 0; k < 3; ++k) {
      const AngleResistance& r = joint.about[k];
      const Vec axis = now.axis[k].normalized();
      Real gives = 0;  // rate of turning for a unit moment
      for (const RigidBody* body : {&a, &b})
        if (!body->fixed()) gives += axis.dot(body->turning_by(axis, body->q));
      const Real stiffness = steepest(r.stiffness) + (r.friction > 0 ? 2 : 1) * r.elastic;
      constexpr Real share = 0.5;  // of the limit of stability: others may push the same body
      Real dt = std::numeric_limits<Real>::infinity();
      if (stiffness * gives > 0) dt = share * 2 / std::sqrt(stiffness * gives);
      if (const Real c = steepest(r.damping) * gives; c > 0) dt = std::min(dt, share / c);
      if (dt < out.dt) out = {dt, fmt::format("joint stiffness {}", joint.id)};
    }
  }
  return out;
}

void JointStiffnesses::keep(Archive& archive) {
  archive("moment", moment_), archive("damping", damping_);
  std::vector<Real> state;
  for (const JointStiffness& joint : joints_)
    for (const AngleResistance& r : joint.about) state.insert(state.end(), {r.angle, r.moment});
  archive("state", state);
  std::size_t k = 0;
  for (JointStiffness& joint : joints_)
    for (AngleResistance& r : joint.about) r.angle = state[k], r.moment = state[k + 1], k += 2;
}

}  // namespace courant
