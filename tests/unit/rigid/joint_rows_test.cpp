// Equations of each kind of joint against what they say in words, their gradients and their changes over a
// step against differences; what they rest on: springs, the sparse matrix, loops of joints.
#include "rigid/joints/joint_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/rotation.hpp"
#include "rigid/joints/joint_matrix.hpp"
#include "rigid/joints/joint_mechanisms.hpp"
#include "rigid/joints/joint_springs.hpp"

namespace courant::joint_rows_test {
namespace {

using Kind = JointKind;
constexpr Kind lower_pairs[] = {
    Kind::spherical,        Kind::revolute,           Kind::cylindrical, Kind::planar,
    Kind::universal,        Kind::translational,      Kind::locking,     Kind::screw,
    Kind::rotational_motor, Kind::translational_motor};

/// Two bodies and a joint between them in no special position, so that each term counts.
struct Pair {
  Joint joint;
  BodyPose a{Vec(1, -2, 0.5), turned_by(Vec(0.3, -0.5, 0.8), Eigen::Quaterniond::Identity())};
  BodyPose b{Vec(-0.4, 1.1, 2), turned_by(Vec(-0.6, 0.2, 0.4), Eigen::Quaterniond::Identity())};
  BodyStep step_a{Vec(0.2, -0.1, 0.3), Vec(0.1, 0.25, -0.2)},
      step_b{Vec(-0.3, 0.2, 0.1), Vec(-0.15, 0.1, 0.3)};

  explicit Pair(Kind kind) {
    joint.kind = kind, joint.b = 1;
    joint.at_a = Vec(0.3, 0.7, -0.2), joint.at_b = Vec(-0.5, 0.4, 0.6);
    joint.axes_a = Eigen::AngleAxisd(0.4, Vec(1, 2, -1).normalized()).toRotationMatrix();
    joint.axes_b = Eigen::AngleAxisd(-0.7, Vec(2, 1, 1).normalized()).toRotationMatrix();
    joint.advance = 0.3, joint.turned = 7, joint.driven = 1.7, joint.coming = 0.23, joint.start = 0.4;
    joint.ratio = 2.5, joint.sense = -1;
  }
  /// The axes of both bodies, for which alone the gradient of a screw holds; its other equations keep them
  /// so.
  void make_parallel() {
    const Matrix A = a.q.toRotationMatrix() * joint.axes_a;
    const Matrix turn = Eigen::AngleAxisd(0.6, Vec(A.col(2))).toRotationMatrix();
    joint.axes_b = b.q.toRotationMatrix().transpose() * turn * A;
  }
  static BodyPose moved(const BodyPose& pose, const BodyStep& step, Real share) {
    const auto& [shift, angle] = step;
    return {pose.x + share * shift, turned_by(share * angle, pose.q)};
  }
  std::vector<JointRow> rows(Real share = 0) const {
    std::vector<JointRow> out;
    add_rows(joint, moved(a, step_a, share), moved(b, step_b, share), out);
    return out;
  }
  std::vector<Real> changes(Real share) const {
    const auto part = [share](const BodyStep& step) {
      const auto& [shift, angle] = step;
      return BodyStep{share * shift, share * angle};
    };
    std::vector<Real> out;
    add_changes(joint, a, b, part(step_a), part(step_b), out);
    return out;
  }
  Real rate(const JointRow& row) const {
    const auto& [shift_a, angle_a] = step_a;
    const auto& [shift_b, angle_b] = step_b;
    return row.v_a.dot(shift_a) + row.w_a.dot(angle_a) + row.v_b.dot(shift_b) + row.w_b.dot(angle_b);
  }
};

/// What the equations of a kind ask for, by the axes of A and B and how far their points are apart.
std::vector<Real> expected_rows(const Pair& p) {
  const Matrix A = p.a.q.toRotationMatrix() * p.joint.axes_a, B = p.b.q.toRotationMatrix() * p.joint.axes_b;
  const Vec d = p.b.x + p.b.q * p.joint.at_b - p.a.x - p.a.q * p.joint.at_a;
  const auto axis = [&](int k) { return Vec(A.col(k)); };
  const auto cosine = [&](int k, int l) { return axis(k).dot(Vec(B.col(l))); };
  const Real angle = std::atan2(cosine(1, 0), cosine(0, 0)) + 2 * pi;  // next to 7
  const std::vector<Real> together = p.joint.yields
                                         ? std::vector<Real>{axis(0).dot(d), axis(1).dot(d), axis(2).dot(d)}
                                         : std::vector<Real>{d[0], d[1], d[2]};
  const std::vector<Real> on_axis{axis(0).dot(d), axis(1).dot(d)}, parallel{cosine(0, 2), cosine(1, 2)};
  const auto all = [](std::initializer_list<std::vector<Real>> lists) {
    std::vector<Real> out;
    for (const auto& one : lists) out.insert(out.end(), one.begin(), one.end());
    return out;
  };
  switch (p.joint.kind) {
    case Kind::spherical:
      return together;
    case Kind::revolute:
      return all({together, parallel});
    case Kind::cylindrical:
      return all({on_axis, parallel});
    case Kind::planar:
      return all({{axis(2).dot(d)}, parallel});
    case Kind::universal:
      return all({together, {cosine(2, 2)}});
    case Kind::translational:
      return all({on_axis, parallel, {cosine(0, 1)}});
    case Kind::locking:
      return all({together, parallel, {cosine(0, 1)}});
    case Kind::screw:
      return all({on_axis, parallel, {axis(2).dot(d) - 0.3 * angle}});
    case Kind::rotational_motor:
      return {angle - 1.7};
    case Kind::translational_motor:
      return {axis(2).dot(d) - 0.4 - 1.7};
    default:
      return {};
  }
}

}  // namespace

TEST(JointRows, EachKindAsksForWhatItsNameSays) {
  for (const bool yields : {false, true})
    for (const Kind kind : lower_pairs) {
      Pair p(kind);
      p.joint.yields = yields;
      const auto rows = p.rows();
      const std::vector<Real> expected = expected_rows(p);
      ASSERT_EQ(rows.size(), expected.size()) << joint_name(kind);
      EXPECT_EQ(rows_of(kind), expected.size()) << joint_name(kind);
      for (std::size_t k = 0; k < rows.size(); ++k)
        EXPECT_NEAR(rows[k].c, expected[k], 1e-13) << joint_name(kind) << " " << k;
    }
}

// The gradient is the slope of c at the start of a motion, by central differences of 1e-4: right to 1e-8 of
// third derivatives of about 1; changes over the whole step are those of c to round-off.
TEST(JointRows, GradientsAndChangesAreThoseOfTheEquations) {
  constexpr Real h = 1e-4;
  for (const bool yields : {false, true})
    for (const Kind kind : lower_pairs) {
      Pair p(kind);
      p.joint.yields = yields;
      if (kind == Kind::screw) p.make_parallel();
      const auto rows = p.rows(), before = p.rows(-h), behind = p.rows(h), after = p.rows(1);
      const std::vector<Real> changes = p.changes(1);
      ASSERT_EQ(changes.size(), rows.size()) << joint_name(kind);
      const Real coming = is_motor(kind) ? p.joint.coming : 0;
      for (std::size_t k = 0; k < rows.size(); ++k) {
        EXPECT_NEAR(p.rate(rows[k]), (behind[k].c - before[k].c) / (2 * h), 1e-7)
            << joint_name(kind) << " " << k;
        EXPECT_NEAR(changes[k], after[k].c - rows[k].c - coming, 1e-13) << joint_name(kind) << " " << k;
        EXPECT_EQ(rows[k].is_length(), !rows[k].v_a.isZero(0)) << joint_name(kind) << " " << k;
      }
    }
}

TEST(JointRows, GradientsOfGearsAreThoseOfTheirChanges) {
  constexpr Real h = 1e-4;
  for (const Kind kind : {Kind::gears, Kind::pulley, Kind::rack_and_pinion})
    for (const bool carried : {false, true}) {
      Pair p(kind);
      p.joint.carried = carried;
      const auto rows = p.rows();
      ASSERT_EQ(rows.size(), 1u);
      EXPECT_EQ(rows_of(kind), 1u);
      EXPECT_EQ(rows[0].c, p.joint.turned) << "what round-off has left so far";
      EXPECT_EQ(rows[0].is_length(), kind == Kind::rack_and_pinion);
      EXPECT_NEAR(p.rate(rows[0]), (p.changes(h)[0] - p.changes(-h)[0]) / (2 * h), 1e-7)
          << joint_name(kind) << carried;
    }
}

// Wheels turn by alpha and beta about z while the line between them turns by phi: R2/R1 (beta - phi) = s
// (alpha - phi); about axes that are not parallel phi does not count. A rack moves by PARM for a turn of its
// pinion by 1.
TEST(JointRows, GearsCountTurnsFromTheirCentreLine) {
  const Real alpha = 0.3, beta = -0.2, phi = 0.15;
  Pair p(Kind::gears);
  p.a = {Vec(0, 0, 0), Eigen::Quaterniond::Identity()}, p.b = {Vec(2, 0, 0), Eigen::Quaterniond::Identity()};
  p.joint.at_a = p.joint.at_b = Vec::Zero();
  p.joint.axes_a = p.joint.axes_b = Matrix::Identity();
  p.step_a = {Vec::Zero(), alpha * Vec::UnitZ()};
  p.step_b = {Vec(2 * std::cos(phi) - 2, 2 * std::sin(phi), 0), beta * Vec::UnitZ()};
  p.joint.carried = true;
  EXPECT_NEAR(p.changes(1)[0], 2.5 * (beta - phi) + (alpha - phi), 1e-13);
  p.joint.carried = false;
  EXPECT_NEAR(p.changes(1)[0], 2.5 * beta + alpha, 1e-13);
  p.joint.kind = Kind::rack_and_pinion, p.joint.advance = 0.5;
  p.joint.axes_b.col(2) = Vec::UnitX();
  p.step_b = {Vec(0.7, 0.1, 0.2), Vec::Zero()};
  EXPECT_NEAR(p.changes(1)[0], 0.7 - 0.5 * alpha, 1e-13);
}

TEST(JointRows, KindsHaveTheirNodesAndNames) {
  const std::tuple<Kind, std::size_t, const char*> kinds[] = {
      {Kind::spherical, 1, "spherical"},
      {Kind::revolute, 2, "revolute"},
      {Kind::cylindrical, 2, "cylindrical"},
      {Kind::planar, 2, "planar"},
      {Kind::universal, 2, "universal"},
      {Kind::translational, 3, "translational"},
      {Kind::locking, 3, "locking"},
      {Kind::screw, 3, "screw"},
      {Kind::rotational_motor, 2, "rotational motor"},
      {Kind::translational_motor, 2, "translational motor"},
      {Kind::gears, 3, "gear"},
      {Kind::rack_and_pinion, 2, "rack and pinion"},
      {Kind::pulley, 2, "pulley"}};
  for (const auto& [kind, pairs, name] : kinds) {
    EXPECT_EQ(pairs_of(kind), pairs) << name;
    EXPECT_STREQ(joint_name(kind), name);
    EXPECT_EQ(is_gear(kind), kind >= Kind::gears) << name;
    EXPECT_EQ(is_motor(kind), kind == Kind::rotational_motor || kind == Kind::translational_motor) << name;
  }
}

// A turn counts on from where it was, by whole turns.
TEST(JointRows, TurnsCountOnFromWhereTheyWere) {
  Pair p(Kind::screw);
  p.joint.axes_a = p.joint.axes_b = Matrix::Identity();
  p.a.q = Eigen::Quaterniond::Identity(), p.b.q = turned_by(Vec(0, 0, 0.5), p.a.q);
  for (const int turns : {-2, 0, 3})
    EXPECT_NEAR(turn_of(p.joint, p.a, p.b, 2 * pi * turns + 1), 2 * pi * turns + 0.5, 1e-13);
  EXPECT_NEAR(turn_of(p.joint, p.a, p.b, 0.5 - 3.2), 0.5 - 2 * pi, 1e-13);
}

// By mean accelerations: the row changes by `give` for a force of 1, and nothing is wrong where the force is
// that of the spring at the mean of the old, the present and the coming stretch, and of the damper at the
// mean rate of both half steps.
TEST(JointRows, SpringsAnswerTheMeanOfTheStep) {
  const Real k = 40, d = 3, rest = 0.1, dt = 0.02, dt_old = 0.01, c = 0.3, change = 0.05, last = 0.02;
  JointSprings springs(2);
  springs.add(1, k, d, rest);
  EXPECT_TRUE(springs.has(1));
  EXPECT_FALSE(springs.has(0));
  Clock clock;
  clock.dt = dt, clock.dt_old = dt_old;
  std::vector<JointRow> rows(2);
  rows[1].c = c - last;
  springs.remember(rows, {0, last}, clock);
  const auto force_for = [&](Real step) {
    const Real mean = (c - last) / 4 + c / 2 + (c + step) / 4;
    return -k * (mean - rest) - d * 0.5 * (step / dt + last / dt_old);
  };
  EXPECT_NEAR(springs.wrong(1, c, change, force_for(change), clock), 0, 1e-14);
  EXPECT_NEAR(springs.wrong(1, c, change, force_for(change) + 1, clock), springs.give(1, clock), 1e-14);
  EXPECT_NEAR(springs.give(1, clock), 1 / (k / 4 + d / (2 * dt)), 1e-14);
}

// A sparse matrix of several bodies against Eigen's solution of the whole one, in any order of the entries;
// rows that say the same twice are left out, and the others are met.
TEST(JointRows, TheMatrixIsSolved) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> number(-1, 1);
  constexpr int n = 9;
  const std::vector<std::array<Index, 2>> entries = {{1, 0}, {4, 2}, {7, 4}, {8, 1}, {5, 8},
                                                     {6, 3}, {3, 0}, {7, 2}, {4, 4}};
  for (const bool twice : {false, true}) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    JointMatrix matrix;
    matrix.arrange(n, entries);
    matrix.clear();
    const auto add = [&](Index row, Index column, Real value) {
      matrix.add(row, column, value);
      dense(row, column) += value;
      if (row != column) dense(column, row) += value;
    };
    for (int k = 0; k < n; ++k) add(k, k, 5 + k);
    for (const auto& [i, j] : entries)
      if (i != j && !twice) add(i, j, number(random));
    if (twice) add(8, 1, std::sqrt(6.0 * 13));  // rows 1 and 8 are then one
    Eigen::VectorXd right(n);
    for (int k = 0; k < n; ++k) right[k] = number(random);
    if (twice) right[8] = right[1] * std::sqrt(13.0 / 6);
    matrix.factorise(dense.diagonal(), 1e-9);
    const Eigen::VectorXd x = matrix.solve(right);
    EXPECT_NEAR((dense * x - right).norm(), 0, 1e-12);
    int left_out = 0;
    for (int k = 0; k < n; ++k) {
      left_out += matrix.left_out(k);
      EXPECT_EQ(matrix.left_out(k), matrix.pivot(k) == 0) << k;
      if (matrix.left_out(k)) EXPECT_EQ(x[k], 0);
      if (!twice) EXPECT_LE(matrix.pivot(k), dense(k, k) * (1 + 1e-12)) << "what a row adds to others";
    }
    EXPECT_EQ(left_out, twice ? 1 : 0);
    if (!twice) EXPECT_NEAR((x - dense.ldlt().solve(right)).norm(), 0, 1e-12);
  }
}

// A chain is no loop, nor is one that hangs at the ground once; two paths to the ground, or a ring, are. What
// holds or drives a body is a path to the ground; a fixed body joins nothing.
TEST(JointRows, LoopsOfJointsAreKnown) {
  const auto body = [](bool fixed) {
    RigidBody b;
    if (fixed) b.held = b.no_turn = {true, true, true};
    return b;
  };
  const auto joint = [](std::size_t a, std::size_t b) {
    Joint j;
    j.a = a, j.b = b;
    return j;
  };
  std::vector<RigidBody> bodies{body(true), body(false), body(false), body(false), body(false)};
  const auto closed = [&](const std::vector<Joint>& joints, std::size_t at = 0) {
    return Mechanisms(joints, bodies).closed(at);
  };
  EXPECT_FALSE(closed({joint(0, 1), joint(1, 2), joint(2, 3)}));
  EXPECT_FALSE(closed({joint(1, 2), joint(2, 3)}));
  EXPECT_TRUE(closed({joint(0, 1), joint(1, 2), joint(2, 0)}));
  EXPECT_TRUE(closed({joint(1, 2), joint(2, 3), joint(3, 1)}));
  EXPECT_FALSE(closed({joint(1, 2), joint(0, 3), joint(3, 0)})) << "the loop is another mechanism's";
  EXPECT_TRUE(closed({joint(1, 2), joint(0, 3), joint(3, 0)}, 1));
  const Mechanisms two({joint(0, 1), joint(0, 2), joint(3, 4), joint(2, 1)}, bodies);
  EXPECT_TRUE(two.same(0, 1));
  EXPECT_FALSE(two.same(0, 2));
  for (int what = 0; what < 3; ++what) {
    RigidBody& b = bodies[2] = body(false);
    EXPECT_FALSE(closed({joint(0, 1), joint(1, 2)}));
    if (what == 0) b.held[1] = true;
    if (what == 1) b.no_turn[2] = true;
    if (what == 2) b.motions.emplace_back();
    EXPECT_TRUE(closed({joint(0, 1), joint(1, 2)})) << what;
  }
}

}  // namespace courant::joint_rows_test
