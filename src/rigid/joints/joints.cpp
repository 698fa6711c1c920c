#include "rigid/joints/joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/run_error.hpp"

namespace courant {

namespace {

/// The part of the identity along which a body is free to move.
Matrix free_part(const RigidBody& b, const Clock* clock) {
  Matrix free = Matrix::Identity();
  for (int k = 0; k < 3; ++k)
    if (b.held[static_cast<std::size_t>(k)]) free(k, k) = 0;
  for (const PrescribedMotion& motion : b.motions)
    if (const Vec d = b.direction_of(motion, b.q);
        !motion.turns && clock && motion.drives(clock->t, clock->dt))
      free -= d * d.transpose();
  return free;
}

Matrix inverse_inertia(const RigidBody& b, const Clock* clock) {
  Matrix out;
  for (int k = 0; k < 3; ++k)
    out.col(k) = clock ? b.turning_beside_drives(Vec::Unit(k), clock) : b.turning_by(Vec::Unit(k), b.q);
  return out;
}

constexpr Real round_off = 1e-13;        // of lengths and angles that a joint may leave
constexpr Real too_far = 1e-4;           // of its own size by which a joint may open
constexpr Real too_far_yielding = 0.05;  // the same of one that is a spring

Index count_rows(const std::vector<Joint>& joints) {
  Index rows = 0;
  for (const Joint& joint : joints) rows += static_cast<Index>(rows_of(joint.kind));
  return rows;
}

}  // namespace

Joints::Joints(std::vector<Joint> joints, std::shared_ptr<RigidBodies> bodies, bool exact, Real tssfac)
    : joints_(std::move(joints)),
      bodies_(std::move(bodies)),
      exact_(exact),
      tssfac_(tssfac),
      springs_(static_cast<std::size_t>(count_rows(joints_))),
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
  std::vector<std::array<Index, 2>> entries;
  for (std::size_t body = 0; body < of_body.size(); ++body) {
    if (bodies_->bodies()[body].fixed()) continue;
    for (const Side& one : of_body[body])
      for (const Side& other : of_body[body]) {
        if (other.row > one.row) continue;  // the lower half is enough
        meetings_.push_back({one.row, other.row, body, one.of_b, other.of_b});
        entries.push_back({one.row, other.row});
      }
  }
  matrix_.arrange(first_row_.back(), entries);
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

std::vector<Real> Joints::changes_of(const std::vector<BodyPose>& poses, const std::vector<JointRow>& rows,
                                     const Eigen::VectorXd& force, const Clock& clock) const {
  const auto more = on_bodies(rows, force);
  std::vector<BodyStep> steps(more.size());
  for (std::size_t k = 0; k < more.size(); ++k) {
    const RigidBody& b = bodies_->bodies()[k];
    if (b.fixed() || !joined_[k]) continue;
    Vec force_on = b.force, moment_on = b.moment;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      if (!b.held[i]) force_on[axis] += more[k][0][axis];
      if (!b.no_turn[i]) moment_on[axis] += more[k][1][axis];
    }
    const HalfStep next = next_half_step(b, force_on, moment_on, clock);
    steps[k] = {next.v * clock.dt, turning_over(b, next.L, clock.dt) * clock.dt};
  }
  std::vector<Real> out;
  out.reserve(rows.size());
  for (const Joint& joint : joints_)
    add_changes(joint, poses[joint.a], poses[joint.b], steps[joint.a], steps[joint.b], out);
  return out;
}

// Of equations that follow from others, and of those about what is held, the matrix is singular, or nearly so
// where the digits of a deck leave axes a little askew by d, which would lock a mechanism: their pivots are
// d^2 of what free bodies would give. Those of a chain that pulls a heavy body are the ratio of the masses.
void Joints::factorise(const std::vector<JointRow>& rows, const Clock* clock, Real least) {
  inverse_.assign(bodies_->bodies().size(), {});
  for (std::size_t k = 0; k < inverse_.size(); ++k) {
    const RigidBody& b = bodies_->bodies()[k];
    if (b.fixed() || !joined_[k]) continue;
    const Real mean = b.J0.trace() / 3;  // a body of rods may have none about an axis
    inverse_[k] = {free_part(b, clock) / b.m, inverse_inertia(b, clock), 1 / b.m, mean > 0 ? 1 / mean : 0};
  }
  free_ = Eigen::VectorXd::Zero(first_row_.back());
  matrix_.clear();
  for (const Meeting& m : meetings_) {
    const JointRow &i = rows[static_cast<std::size_t>(m.row)], &j = rows[static_cast<std::size_t>(m.column)];
    const Inverse& of = inverse_[m.body];
    const Vec &vi = m.row_of_b ? i.v_b : i.v_a, &wi = m.row_of_b ? i.w_b : i.w_a;
    matrix_.add(m.row, m.column,
                vi.dot(of.mass * (m.column_of_b ? j.v_b : j.v_a)) +
                    wi.dot(of.inertia * (m.column_of_b ? j.w_b : j.w_a)));
    if (m.row == m.column)
      free_[m.row] += of.free_mass * vi.squaredNorm() + of.free_inertia * wi.squaredNorm();
  }
  for (Index k = 0; k < first_row_.back(); ++k)
    if (springs_.has(k)) matrix_.add(k, k, springs_.give(k, *clock) / (clock->dt * clock->dt_mean()));
  matrix_.factorise(free_, least);
}

// A tenth of what would make a joint of free bodies swing by one radian in the first step that was allowed:
// not in the step of now, or shorter steps would make stiffer joints.
void Joints::add_springs(const std::vector<JointRow>& rows, const Clock& clock) {
  constexpr Real stiffness = 0.1, damping = 0.1;  // damping: of the critical one
  const Real step = std::isfinite(first_allowed_) && first_allowed_ > 0 ? first_allowed_ : clock.dt;
  bool added = false;
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (Index k = first_row_[j]; joints_[j].yields && k < first_row_[j + 1]; ++k) {
      if (springs_.has(k) || !(free_[k] > 0)) continue;
      const Real own = joints_[j].rps * stiffness / (free_[k] * step * step);
      springs_.add(k, own, joints_[j].damp * 2 * damping * std::sqrt(own / free_[k]),
                   rows[static_cast<std::size_t>(k)].c);
      added = true;
    }
  if (added) factorise(rows, &clock, follows_from_others);
}

std::array<Real, 2> Joints::sizes(const Joint& joint) const {
  Real coordinates = joint.at_a.norm() + joint.at_b.norm(), own = 0;
  for (const bool second : {false, true}) {
    const RigidBody& b = bodies_->bodies()[second ? joint.b : joint.a];
    const Real reach = std::sqrt(b.J0.trace() / b.m);
    coordinates += b.x.norm() + reach;
    const Real size = reach + (second ? joint.at_b : joint.at_a).norm();
    if (!b.fixed() && (own == 0 || size < own)) own = size;
  }
  return {coordinates, own};
}

void Joints::find_rooms(const std::vector<JointRow>& rows) {
  room_.clear(), too_far_.clear();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const auto [coordinates, own] = sizes(joints_[j]);
    for (Index k = first_row_[j]; k < first_row_[j + 1]; ++k) {
      const bool length = rows[static_cast<std::size_t>(k)].is_length();
      const Joint& joint = joints_[j];
      const Real turned = is_motor(joint.kind) ? std::abs(joint.driven) : 0;  // its digits, too
      room_.push_back(round_off * ((length ? coordinates : 1) + turned));
      const Real share = joint.yields ? too_far_yielding : too_far;
      too_far_.push_back(std::max(share * (length ? own : 1), 10 * room_.back()));
    }
  }
}

Eigen::VectorXd Joints::wanted(const std::vector<JointRow>& rows) const {
  constexpr Real slowly = 1e-4, soon = 0.05;  // of a gap, in a step
  Eigen::VectorXd out(first_row_.back());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Real inside = std::clamp(rows[k].c, -room_[k], room_[k]);
    out[static_cast<Index>(k)] = -(slowly * inside + soon * (rows[k].c - inside));
  }
  return out;
}

Eigen::VectorXd Joints::find_force(const std::vector<BodyPose>& poses, const std::vector<JointRow>& rows,
                                   const Clock& clock) const {
  const Eigen::VectorXd target = wanted(rows), weight = free_.cwiseSqrt();
  Eigen::VectorXd force = Eigen::VectorXd::Zero(first_row_.back()), wrong(first_row_.back());
  constexpr int most_rounds = 60, patience = 6;
  constexpr Real stalled = 0.5, enough = 1e-9;  // of the force
  Real last = 0;
  for (int round = 0, idle = 0; round < most_rounds && idle < patience; ++round) {
    const std::vector<Real> changes = changes_of(poses, rows, force, clock);
    Real share = 0;  // of what round-off may leave
    for (Index k = 0; k < first_row_.back(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      wrong[k] = springs_.has(k) ? springs_.wrong(k, rows[i].c, changes[i], sum_[k] + force[k], clock)
                                 : changes[i] - target[k];
      if (!matrix_.left_out(k)) share = std::max(share, std::abs(wrong[k]) / room_[i]);
    }
    const Eigen::VectorXd more = matrix_.solve(wrong) / (clock.dt * clock.dt_mean());
    const Real size = more.cwiseProduct(weight).cwiseAbs().maxCoeff();
    if (!std::isfinite(size)) break;
    const Real all = (sum_ + force).cwiseProduct(weight).cwiseAbs().maxCoeff();
    const bool met = round > 0 && share <= 1 && size <= enough * all;
    force -= more;  // even the last one: what is left of each step adds up
    if (met) break;
    idle += round > 0 && size > stalled * last;
    last = size;
  }
  return force;
}

void Joints::look_at_gaps(const std::vector<JointRow>& rows, const std::vector<Real>& changes, World& world,
                          const Clock& clock) {
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (Index k = first_row_[j]; k < first_row_[j + 1]; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Real gap = std::abs(rows[i].c + changes[i]);
      const RigidBody &a = bodies_->bodies()[joints_[j].a], &b = bodies_->bodies()[joints_[j].b];
      if (a.fixed() && b.fixed()) continue;
      const bool spring = springs_.has(k);
      const bool gives_way = gap > too_far_[i] && !exact_ && !spring && can_yield(joints_[j]);
      if (gives_way) soften(j);
      if (!(gap <= too_far_[i]) && !gives_way)
        throw RunError(
            fmt::format(
                "t = {:g}: {} joint {} between parts {} and {} cannot be held: it is open by {:.3g} {}",
                clock.t, joint_name(joints_[j].kind), joints_[j].id, a.part, b.part, gap,
                rows[i].is_length() ? "[L]" : "radians"),
            fmt::format(
                "see whether other joints, prescribed motions and held directions of its bodies allow its "
                "motion, or take a step shorter than {:.3g} (TSSFAC of *CONTROL_TIMESTEP)",
                clock.dt));
      if (gap <= room_[i]) continue;
      const auto note = [&](const char* name, Real value) {
        Real& most = world.maxima[name];
        most = std::max(most, value);
      };
      if (rows[i].is_length()) note("joint_gap", gap);
      note(spring ? "joint_spring_gap_share" : "joint_gap_share",
           (spring ? too_far_yielding : too_far) * gap / too_far_[i]);
    }
}

Real Joints::rate_of(const JointRow& row, const RigidBody& a, const RigidBody& b) {
  return row.v_b.dot(b.v) + row.w_b.dot(b.omega) + row.v_a.dot(a.v) + row.w_a.dot(a.omega);
}

void Joints::begin(const Clock& clock) {
  if (begun_at_ == clock.t) return;
  begun_at_ = clock.t;
  for (Joint& joint : joints_)
    if (is_motor(joint.kind))
      joint.driven = joint.drive.until(clock.t), joint.coming = joint.drive.over(clock.t, clock.dt);
  poses_ = poses_now();
  rows_ = rows_at(poses_);
  factorise(rows_, &clock, follows_from_others);
  add_springs(rows_, clock);
  find_rooms(rows_);
  sum_ = Eigen::VectorXd::Zero(first_row_.back());
  push(find_force(poses_, rows_, clock));
}

void Joints::push(const Eigen::VectorXd& force) {
  const auto on = on_bodies(rows_, force);
  for (std::size_t k = 0; k < on.size(); ++k)
    if (tied(k)) bodies_->push(k, on[k][0], on[k][1]);
  sum_ += force;
}

Eigen::VectorXd Joints::answer_to(std::size_t body, const Vec& force, const Vec& moment) const {
  const Vec v = inverse_[body].mass * force, omega = inverse_[body].inertia * moment;
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(first_row_.back());
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (Index k = first_row_[j]; k < first_row_[j + 1]; ++k) {
      const JointRow& row = rows_[static_cast<std::size_t>(k)];
      if (joints_[j].a == body) rate[k] += row.v_a.dot(v) + row.w_a.dot(omega);
      if (joints_[j].b == body) rate[k] += row.v_b.dot(v) + row.w_b.dot(omega);
    }
  return -matrix_.solve(rate);
}

Real Joints::give(std::size_t body, const Vec& q, const Vec& n) const {
  const Vec arm = (q - bodies_->bodies()[body].x).cross(n);
  const auto [force, moment] = on_bodies(rows_, answer_to(body, n, arm))[body];
  // what joints hold gives nothing, but for round-off
  return std::max(n.dot(inverse_[body].mass * (n + force)) + arm.dot(inverse_[body].inertia * (arm + moment)),
                  Real(0));
}

void Joints::answer(std::size_t body, const Vec& force, const Vec& moment) {
  push(answer_to(body, force, moment));
}

// Where bodies were struck since begin(): what answers, which are linear, left.
void Joints::strike(World& world, const Clock& clock) {
  const bool begun = begun_at_ == clock.t;
  begin(clock);
  if (begun) push(find_force(poses_, rows_, clock));
  const std::vector<Real> changes =
      changes_of(poses_, rows_, Eigen::VectorXd::Zero(first_row_.back()), clock);
  look_at_gaps(rows_, changes, world, clock);
  springs_.remember(rows_, changes, clock);
  remember(rows_, sum_, changes);
}

// The work of a force along a row, by what its bodies do over both half steps that it pushes.
void Joints::record(World&, const Clock& clock, EnergyLedger& ledger) {
  ledger.dissipated += springs_.lost(), ledger.throughput += springs_.lost();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (!is_motor(joints_[j].kind)) continue;
    const auto middle = [&](RigidBody b) {
      if (b.fixed()) return b;
      const HalfStep next = next_half_step(b, clock);
      b.v = 0.5 * (b.v + next.v), b.omega = 0.5 * (b.omega + turning_over(b, next.L, clock.dt));
      return b;
    };
    const RigidBody a = middle(bodies_->bodies()[joints_[j].a]), b = middle(bodies_->bodies()[joints_[j].b]);
    const Index k = first_row_[j];
    const Real work = clock.dt_mean() * sum_[k] * rate_of(rows_[static_cast<std::size_t>(k)], a, b);
    ledger.external_work += work, ledger.throughput += std::abs(work);
  }
}

// The multipliers as a force on B where the joint is in it, and a moment.
void Joints::remember(const std::vector<JointRow>& rows, const Eigen::VectorXd& force,
                      const std::vector<Real>& changes) {
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
    if (is_gear(joint.kind))
      joint.turned += changes[static_cast<std::size_t>(first_row_[j])];
    else
      joint.turned = turn_of(joint, after[joint.a], after[joint.b], joint.turned);
  }
}

// Limits of elements go with TSSFAC, which counts as 0.9 here.
Real Joints::allowed_by_others(const World& world, const Clock& clock) const {
  constexpr Real usual = 0.9;
  Real out = std::numeric_limits<Real>::infinity();
  for (TimeLimit* other : world.passes.all<TimeLimit>())
    if (other != this)
      out = std::min(out, (other->rings() ? usual / tssfac_ : 1) * other->limit(world, clock).dt);
  return out;
}

// A body at whose arm r a joint pulls by F turns back as if by a spring F r about axes across r.
TimeLimit::Limit Joints::limit(const World& world, const Clock& clock) {
  if (first_allowed_ == 0) first_allowed_ = allowed_by_others(world, clock);
  std::vector<Real> rate2(bodies_->bodies().size(), 0);
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (const bool second : {false, true}) {
      const std::size_t body = second ? joints_[j].b : joints_[j].a;
      const RigidBody& b = bodies_->bodies()[body];
      const Vec arm = b.q * (second ? joints_[j].at_b : joints_[j].at_a);
      const Real pull = force_[j].norm() * arm.norm();
      if (b.fixed() || !(pull > 0)) continue;
      Real give = 0;
      const Matrix across = Matrix::Identity() - arm * arm.transpose() / arm.squaredNorm();
      for (int k = 0; k < 3; ++k) give += across.col(k).dot(b.turning_by(Vec(across.col(k)), b.q));
      rate2[body] += pull * give;
    }
  Limit out{std::numeric_limits<Real>::infinity(), ""};
  for (std::size_t k = 0; k < rate2.size(); ++k)
    if (const Real dt = 1 / std::sqrt(rate2[k]); dt < out.dt)
      out = {dt, fmt::format("joints of rigid body {}", bodies_->bodies()[k].part)};
  return out;
}

void Joints::report_joints(std::vector<JointForce>& out) const {
  for (std::size_t j = 0; j < joints_.size(); ++j)
    out.push_back({.id = joints_[j].id, .title = joints_[j].title, .force = force_[j], .moment = moment_[j]});
}

void Joints::keep(Archive& archive) {
  archive("force", force_), archive("moment", moment_);
  std::vector<Real> turned;
  for (const Joint& joint : joints_) turned.insert(turned.end(), {joint.turned, joint.drive.start_rate});
  archive("turned", turned);
  springs_.keep(archive);
  archive("first_allowed", first_allowed_);
  std::vector<int> yields;
  for (const Joint& joint : joints_) yields.push_back(joint.yields);
  archive("yields", yields);
  for (std::size_t j = 0; j < joints_.size(); ++j) joints_[j].yields = yields[j] != 0;
  for (std::size_t j = 0; j < joints_.size(); ++j)
    joints_[j].turned = turned[2 * j], joints_[j].drive.start_rate = turned[2 * j + 1];
}

}  // namespace courant
