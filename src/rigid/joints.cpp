#include "rigid/joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/run_error.hpp"

namespace courant {

namespace {

/// The part of the identity along which a body is free, in turns or in translations.
Matrix free_part(const RigidBody& b, bool turns, const Clock* clock) {
  Matrix free = Matrix::Identity();
  for (int k = 0; k < 3; ++k)
    if (turns ? b.no_turn[static_cast<std::size_t>(k)] : b.held[static_cast<std::size_t>(k)]) free(k, k) = 0;
  for (const PrescribedMotion& motion : b.motions)
    if (motion.turns == turns && clock && motion.drives(clock->t, clock->dt))
      free -= motion.direction * motion.direction.transpose();
  return free;
}

Matrix inverse_inertia(const RigidBody& b, const Clock* clock) {
  const Matrix free = free_part(b, true, clock);
  Matrix out;
  for (int k = 0; k < 3; ++k) out.col(k) = free * b.turning_by(Vec(free.col(k)), b.q);
  return out;
}

constexpr Real round_off = 1e-13;  // of lengths and angles that a joint may leave

}  // namespace

Joints::Joints(std::vector<Joint> joints, std::shared_ptr<RigidBodies> bodies)
    : joints_(std::move(joints)),
      bodies_(std::move(bodies)),
      force_(joints_.size(), Vec::Zero()),
      moment_(joints_.size(), Vec::Zero()) {
  joined_.assign(bodies_->bodies().size(), 0);
  Index rows = 0;
  for (const Joint& joint : joints_) {
    joined_[joint.a] = joined_[joint.b] = 1;
    first_row_.push_back(rows);
    rows += static_cast<Index>(rows_of(joint.kind));
  }
  first_row_.push_back(rows);
  find_meetings();
}

void Joints::find_meetings() {
  std::vector<std::vector<Side>> of_body(bodies_->bodies().size());
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (Index row = first_row_[j]; row < first_row_[j + 1]; ++row) {
      of_body[joints_[j].a].push_back({row, false});
      of_body[joints_[j].b].push_back({row, true});
    }
  std::vector<Eigen::Triplet<double>> entries;
  for (Index row = 0; row < first_row_.back(); ++row) entries.emplace_back(row, row, 1.0);
  for (std::size_t body = 0; body < of_body.size(); ++body) {
    if (bodies_->bodies()[body].fixed()) continue;
    for (const Side& one : of_body[body])
      for (const Side& other : of_body[body]) {
        if (other.row > one.row) continue;  // the lower half is enough
        meetings_.push_back({one.row, other.row, body, one.of_b, other.of_b});
        entries.emplace_back(one.row, other.row, 1.0);
      }
  }
  matrix_.resize(first_row_.back(), first_row_.back());
  matrix_.setFromTriplets(entries.begin(), entries.end());
  solver_.analyzePattern(matrix_);
}

std::vector<BodyPose> Joints::poses_now() const {
  std::vector<BodyPose> out;
  for (const RigidBody& b : bodies_->bodies()) out.push_back({b.x, b.q});
  return out;
}

std::vector<JointRow> Joints::rows_at(const std::vector<BodyPose>& poses) const {
  std::vector<JointRow> rows;
  rows.reserve(static_cast<std::size_t>(first_row_.back()));
  for (const Joint& joint : joints_) add_rows(joint, poses[joint.a], poses[joint.b], rows);
  return rows;
}

std::vector<std::array<Vec, 2>> Joints::on_bodies(const std::vector<JointRow>& rows,
                                                  const Eigen::VectorXd& force) const {
  std::vector<std::array<Vec, 2>> out(bodies_->bodies().size(), {Vec::Zero(), Vec::Zero()});
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (Index k = first_row_[j]; k < first_row_[j + 1]; ++k) {
      const JointRow& row = rows[static_cast<std::size_t>(k)];
      out[joints_[j].a][0] += force[k] * row.v_a, out[joints_[j].a][1] += force[k] * row.w_a;
      out[joints_[j].b][0] += force[k] * row.v_b, out[joints_[j].b][1] += force[k] * row.w_b;
    }
  return out;
}

std::vector<BodyPose> Joints::poses_after(const std::vector<JointRow>& rows, const Eigen::VectorXd& force,
                                          const Clock& clock) const {
  const auto more = on_bodies(rows, force);
  std::vector<BodyPose> out;
  for (std::size_t k = 0; k < more.size(); ++k) {
    const RigidBody& b = bodies_->bodies()[k];
    out.push_back({b.x, b.q});
    if (b.fixed() || !joined_[k]) continue;
    Vec force_on = b.force, moment_on = b.moment;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      if (!b.held[i]) force_on[axis] += more[k][0][axis];
      if (!b.no_turn[i]) moment_on[axis] += more[k][1][axis];
    }
    out.back() = pose_after(b, next_half_step(b, force_on, moment_on, clock), clock.dt);
  }
  return out;
}

// Of equations that follow from others, and of those about what is held, the matrix is singular, or nearly so
// where the digits of a deck leave axes a little askew, which would lock a mechanism: a little more on the
// diagonal, of what free bodies would give, lets such equations share the force and be met as far as they
// can.
void Joints::factorise(const std::vector<JointRow>& rows, const Clock* clock) {
  std::vector<Inverse> inverse(bodies_->bodies().size());
  for (std::size_t k = 0; k < inverse.size(); ++k) {
    const RigidBody& b = bodies_->bodies()[k];
    if (b.fixed() || !joined_[k]) continue;
    const Real mean = b.J0.trace() / 3;  // a body of rods may have none about an axis
    inverse[k] = {free_part(b, false, clock) / b.m, inverse_inertia(b, clock), 1 / b.m,
                  mean > 0 ? 1 / mean : 0};
  }
  Eigen::VectorXd free = Eigen::VectorXd::Zero(first_row_.back());
  for (Eigen::Index k = 0; k < matrix_.nonZeros(); ++k) matrix_.valuePtr()[k] = 0;
  for (const Meeting& m : meetings_) {
    const JointRow &i = rows[static_cast<std::size_t>(m.row)], &j = rows[static_cast<std::size_t>(m.column)];
    const Inverse& of = inverse[m.body];
    const Vec &vi = m.row_of_b ? i.v_b : i.v_a, &wi = m.row_of_b ? i.w_b : i.w_a;
    matrix_.coeffRef(m.row, m.column) += vi.dot(of.mass * (m.column_of_b ? j.v_b : j.v_a)) +
                                         wi.dot(of.inertia * (m.column_of_b ? j.w_b : j.w_a));
    if (m.row == m.column)
      free[m.row] += of.free_mass * vi.squaredNorm() + of.free_inertia * wi.squaredNorm();
  }
  constexpr Real more = 1e-6;
  for (Index k = 0; k < first_row_.back(); ++k)
    matrix_.coeffRef(k, k) += free[k] > 0 ? more * free[k] : 1;  // 0: nothing moves there
  solver_.factorize(matrix_);
}

Real Joints::worst(const std::vector<JointRow>& rows, std::size_t& joint) const {
  Real out = 0;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Joint& one = joints_[j];
    Real size = one.at_a.norm() + one.at_b.norm();
    for (const std::size_t body : {one.a, one.b}) {
      const RigidBody& b = bodies_->bodies()[body];
      size += b.x.norm() + std::sqrt(b.J0.trace() / b.m);
    }
    for (Index k = first_row_[j]; k < first_row_[j + 1]; ++k) {
      const JointRow& row = rows[static_cast<std::size_t>(k)];
      const bool length = !row.v_a.isZero(0);
      const Real share = std::abs(row.c) / (round_off * (length ? size : 1));
      if (share > out || std::isnan(share)) out = share, joint = j;
    }
  }
  return out;
}

std::array<Real, 2> Joints::make_start_consistent(World& world) {
  const Real before = bodies_->kinetic_energy();
  const std::vector<JointRow> rows = rows_at(poses_now());
  factorise(rows, nullptr);
  constexpr int rounds = 4;  // the later ones for what the little more on the diagonal left
  for (int round = 0; round < rounds; ++round) {
    Eigen::VectorXd rate(first_row_.back());
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const RigidBody &a = bodies_->bodies()[joints_[j].a], &b = bodies_->bodies()[joints_[j].b];
      for (Index k = first_row_[j]; k < first_row_[j + 1]; ++k) {
        const JointRow& row = rows[static_cast<std::size_t>(k)];
        rate[k] = row.v_b.dot(b.v) + row.w_b.dot(b.omega) + row.v_a.dot(a.v) + row.w_a.dot(a.omega);
      }
    }
    const auto impulse = on_bodies(rows, -solver_.solve(rate));
    for (std::size_t k = 0; k < impulse.size(); ++k)
      if (joined_[k] && !bodies_->bodies()[k].fixed())
        bodies_->strike_at_start(k, impulse[k][0], impulse[k][1], world);
  }
  return {before, bodies_->kinetic_energy()};
}

// Of places, in the summary: a closed loop whose axes are a little askew cannot be met by rigid bodies.
void Joints::tell_gap(const std::vector<JointRow>& rows, World& world) const {
  Real& most = world.maxima["joint_gap"];
  for (const JointRow& row : rows)
    if (!row.v_a.isZero(0)) most = std::max(most, std::abs(row.c));
}

void Joints::strike(World& world, const Clock& clock) {
  const std::vector<JointRow> rows = rows_at(poses_now());
  factorise(rows, &clock);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(first_row_.back()), wrong(first_row_.back());
  constexpr int most_rounds = 60, patience = 3;
  constexpr Real stalled = 0.5, good_enough = 1e9;  // a share of 1e-4
  Real last = 0;
  std::size_t joint = 0;
  for (int round = 0, idle = 0;; ++round) {
    const std::vector<JointRow> after = rows_at(poses_after(rows, force, clock));
    const Real share = worst(after, joint);
    if (share <= 1) break;
    idle += round > 0 && share > stalled * last;
    if (share < good_enough && (idle == patience || round == most_rounds)) {
      tell_gap(after, world);
      break;
    }
    if (round == most_rounds || !std::isfinite(share))
      throw RunError(fmt::format(
          "t = {:g}: {} joint {} between parts {} and {} cannot be held: what drives or holds its bodies, "
          "other joints or a step of {:.3g} that is too long for their motion do not let it",
          clock.t, joint_name(joints_[joint].kind), joints_[joint].id,
          bodies_->bodies()[joints_[joint].a].part, bodies_->bodies()[joints_[joint].b].part, clock.dt));
    last = share;
    for (Index k = 0; k < first_row_.back(); ++k) wrong[k] = after[static_cast<std::size_t>(k)].c;
    force -= solver_.solve(wrong) / (clock.dt * clock.dt_mean());
  }
  const auto on = on_bodies(rows, force);
  for (std::size_t k = 0; k < on.size(); ++k)
    if (joined_[k] && !bodies_->bodies()[k].fixed()) bodies_->push(k, on[k][0], on[k][1]);
  remember(rows, force);
}

// The multipliers as a force on B where the joint is in it, and a moment.
void Joints::remember(const std::vector<JointRow>& rows, const Eigen::VectorXd& force) {
  const std::vector<BodyPose> after = poses_now();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    Joint& joint = joints_[j];
    force_[j].setZero(), moment_[j].setZero();
    for (Index k = first_row_[j]; k < first_row_[j + 1]; ++k) {
      const JointRow& row = rows[static_cast<std::size_t>(k)];
      force_[j] += force[k] * row.v_b, moment_[j] += force[k] * row.w_b;
    }
    const RigidBody& b = bodies_->bodies()[joint.b];
    moment_[j] -= (b.q * joint.at_b).cross(force_[j]);
    joint.turned = turn_of(joint, after[joint.a], after[joint.b], joint.turned);
  }
}

void Joints::report_joints(std::vector<JointForce>& out) const {
  for (std::size_t j = 0; j < joints_.size(); ++j)
    out.push_back({.id = joints_[j].id, .title = joints_[j].title, .force = force_[j], .moment = moment_[j]});
}

void Joints::keep(Archive& archive) {
  archive("force", force_), archive("moment", moment_);
  std::vector<Real> turned;
  for (const Joint& joint : joints_) turned.push_back(joint.turned);
  archive("turned", turned);
  for (std::size_t j = 0; j < joints_.size(); ++j) joints_[j].turned = turned[j];
}

}  // namespace courant
