#include "rigid/joints/joint_rows.hpp"

#include <cmath>

#include "rigid/joints/joint_gears.hpp"

namespace courant {

namespace {

/// A joint where its bodies are now.
struct PlacedJoint {
  Vec arm_a, arm_b;  ///< from the centres to the joint's position in each body
  Vec d;             ///< from A's position to B's
  Matrix axes_a, axes_b;

  PlacedJoint(const Joint& joint, const BodyPose& a, const BodyPose& b) {
    const Matrix turn_a = a.q.toRotationMatrix(), turn_b = b.q.toRotationMatrix();
    arm_a = turn_a * joint.at_a, arm_b = turn_b * joint.at_b;
    d = (b.x - a.x) + (arm_b - arm_a);
    axes_a = turn_a * joint.axes_a, axes_b = turn_b * joint.axes_b;
  }

  /// Places apart along a global direction.
  JointRow apart_globally(const Vec& n) const {
    return {n.dot(d), Vec(-n), Vec(-arm_a.cross(n)), n, arm_b.cross(n)};
  }
  /// Places apart along an axis of A, which turns with it.
  JointRow apart(int k) const {
    const Vec n = axes_a.col(k);
    return {n.dot(d), Vec(-n), Vec(-(arm_a + d).cross(n)), n, arm_b.cross(n)};
  }
  /// Cosine between an axis of A and one of B.
  JointRow cosine(int of_a, int of_b) const {
    const Vec u = axes_a.col(of_a), w = axes_b.col(of_b), turn = u.cross(w);
    return {u.dot(w), Vec::Zero(), turn, Vec::Zero(), Vec(-turn)};
  }
};

}  // namespace

std::size_t pairs_of(JointKind kind) {
  switch (kind) {
    case JointKind::spherical:
      return 1;
    case JointKind::revolute:
    case JointKind::cylindrical:
    case JointKind::planar:
    case JointKind::universal:
    case JointKind::rotational_motor:
    case JointKind::translational_motor:
    case JointKind::rack_and_pinion:
    case JointKind::pulley:
      return 2;
    case JointKind::translational:
    case JointKind::locking:
    case JointKind::screw:
    case JointKind::gears:
      return 3;
  }
  return 0;
}

std::size_t rows_of(JointKind kind) {
  switch (kind) {
    case JointKind::spherical:
    case JointKind::planar:
      return 3;
    case JointKind::cylindrical:
    case JointKind::universal:
      return 4;
    case JointKind::revolute:
    case JointKind::translational:
    case JointKind::screw:
      return 5;
    case JointKind::locking:
      return 6;
    case JointKind::rotational_motor:
    case JointKind::translational_motor:
    case JointKind::gears:
    case JointKind::rack_and_pinion:
    case JointKind::pulley:
      return 1;
  }
  return 0;
}

const char* joint_name(JointKind kind) {
  constexpr std::array names{
      "spherical",     "revolute",        "cylindrical", "planar",           "universal",
      "translational", "locking",         "screw",       "rotational motor", "translational motor",
      "gear",          "rack and pinion", "pulley"};
  return names[static_cast<std::size_t>(kind)];
}

namespace {

/// Calls `rows` for each equation of a joint, in their order. The force of a spring acts on both bodies at
/// the same point, so that a joint that is open makes no moment: its axes turn with A.
template <class Rows>
void each_row(const Joint& joint, const Rows& rows) {
  const auto together = [&] {
    for (int k = 0; k < 3; ++k) joint.yields ? rows.apart(k) : rows.apart_globally(k);
  };
  const auto on_axis = [&] { rows.apart(0), rows.apart(1); };
  const auto parallel = [&] { rows.cosine(0, 2), rows.cosine(1, 2); };
  switch (joint.kind) {
    case JointKind::spherical:
      return together();
    case JointKind::revolute:
      return together(), parallel();
    case JointKind::cylindrical:
      return on_axis(), parallel();
    case JointKind::planar:
      return rows.apart(2), parallel();
    case JointKind::universal:
      return together(), rows.cosine(2, 2);
    case JointKind::translational:
      return on_axis(), parallel(), rows.cosine(0, 1);
    case JointKind::locking:
      return together(), parallel(), rows.cosine(0, 1);
    case JointKind::screw:
      return on_axis(), parallel(), rows.advance();
    case JointKind::rotational_motor:
      return rows.driven_turn();
    case JointKind::translational_motor:
      return rows.driven_way();
    case JointKind::gears:
    case JointKind::pulley:
      return rows.gears();
    case JointKind::rack_and_pinion:
      return rows.rack();
  }
}

/// The equations where the bodies are.
struct Rows {
  const Joint& joint;
  const BodyPose &a, &b;
  const PlacedJoint& now;
  std::vector<JointRow>& out;

  void apart_globally(int k) const { out.push_back(now.apart_globally(Vec::Unit(k))); }
  void apart(int k) const { out.push_back(now.apart(k)); }
  void cosine(int of_a, int of_b) const { out.push_back(now.cosine(of_a, of_b)); }
  void advance() const {
    JointRow row = now.apart(2);
    const Vec e = now.axes_a.col(2);
    row.c -= joint.advance * turn_of(joint, a, b, joint.turned);
    row.w_a += joint.advance * e, row.w_b -= joint.advance * e;
    out.push_back(row);
  }
  /// The gradient of the angle holds for axes that are not parallel, too.
  void driven_turn() const {
    const JointRow cosine = now.cosine(0, 0), sine = now.cosine(1, 0);
    const Real size2 = cosine.c * cosine.c + sine.c * sine.c;
    out.push_back({.c = turn_of(joint, a, b, joint.turned) - joint.driven,
                   .w_a = (cosine.c * sine.w_a - sine.c * cosine.w_a) / size2,
                   .w_b = (cosine.c * sine.w_b - sine.c * cosine.w_b) / size2,
                   .angle = true});
  }
  void driven_way() const {
    JointRow row = now.apart(2);
    row.c -= joint.start + joint.driven;
    out.push_back(row);
  }
  void gears() const { out.push_back(PlacedGears(joint, a, b).row(joint)); }
  void rack() const { out.push_back(PlacedRack(joint, a, b).row(joint)); }
};

/// How the equations change over a step, from products of what changes: no difference of large numbers.
struct Changes {
  const Joint& joint;
  const BodyPose &a, &b;
  const BodyStep &step_a, &step_b;
  const PlacedJoint& now;
  std::vector<Real>& out;
  Vec d = Vec::Zero();  ///< changes of PlacedJoint's
  Matrix axes_a = Matrix::Zero(), axes_b = Matrix::Zero();

  /// Once the others are set.
  void find() {
    d = (step_b.way - step_a.way) + (turning(step_b.angle, now.arm_b) - turning(step_a.angle, now.arm_a));
    for (int k = 0; k < 3; ++k) {
      axes_a.col(k) = turning(step_a.angle, now.axes_a.col(k));
      axes_b.col(k) = turning(step_b.angle, now.axes_b.col(k));
    }
  }
  void apart_globally(int k) const { out.push_back(d[k]); }
  Real along(int k) const { return axes_a.col(k).dot(now.d) + (now.axes_a.col(k) + axes_a.col(k)).dot(d); }
  void apart(int k) const { out.push_back(along(k)); }
  Real of_cosine(int of_a, int of_b) const {
    return axes_a.col(of_a).dot(now.axes_b.col(of_b)) +
           (now.axes_a.col(of_a) + axes_a.col(of_a)).dot(axes_b.col(of_b));
  }
  void cosine(int of_a, int of_b) const { out.push_back(of_cosine(of_a, of_b)); }
  Real turn() const {
    const Real c = now.axes_a.col(0).dot(now.axes_b.col(0)), s = now.axes_a.col(1).dot(now.axes_b.col(0));
    const Real dc = of_cosine(0, 0), ds = of_cosine(1, 0);
    return std::atan2(ds * c - dc * s, c * (c + dc) + s * (s + ds));
  }
  void advance() const { out.push_back(along(2) - joint.advance * turn()); }
  void driven_turn() const { out.push_back(turn() - joint.coming); }
  void driven_way() const { out.push_back(along(2) - joint.coming); }
  void gears() const { out.push_back(PlacedGears(joint, a, b).change(joint, step_a, step_b)); }
  void rack() const { out.push_back(PlacedRack(joint, a, b).change(joint, step_a, step_b)); }
};

}  // namespace

void add_rows(const Joint& joint, const BodyPose& a, const BodyPose& b, std::vector<JointRow>& rows) {
  const PlacedJoint now(joint, a, b);
  each_row(joint, Rows{joint, a, b, now, rows});
}

void add_changes(const Joint& joint, const BodyPose& a, const BodyPose& b, const BodyStep& step_a,
                 const BodyStep& step_b, std::vector<Real>& changes) {
  const PlacedJoint now(joint, a, b);
  Changes rows{joint, a, b, step_a, step_b, now, changes};
  rows.find();
  each_row(joint, rows);
}

Real turn_of(const Joint& joint, const BodyPose& a, const BodyPose& b, Real near) {
  const PlacedJoint now(joint, a, b);
  const Vec t1 = now.axes_b.col(0);
  const Real angle = std::atan2(t1.dot(Vec(now.axes_a.col(1))), t1.dot(Vec(now.axes_a.col(0))));
  return angle + 2 * pi * std::round((near - angle) / (2 * pi));
}

}  // namespace courant
