#include "rigid/joint_rows.hpp"

#include <cmath>

namespace courant {

namespace {

/// A joint where its bodies are now.
struct PlacedJoint {
  Vec arm_a, arm_b;  ///< from the centres to the joint's place in each body
  Vec d;             ///< from A's place to B's
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
      return 2;
    case JointKind::translational:
    case JointKind::locking:
    case JointKind::screw:
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
  }
  return 0;
}

const char* joint_name(JointKind kind) {
  constexpr std::array names{"spherical", "revolute",      "cylindrical", "planar",
                             "universal", "translational", "locking",     "screw"};
  return names[static_cast<std::size_t>(kind)];
}

void add_rows(const Joint& joint, const BodyPose& a, const BodyPose& b, std::vector<JointRow>& rows) {
  const PlacedJoint now(joint, a, b);
  const auto together = [&] {
    for (int k = 0; k < 3; ++k) rows.push_back(now.apart_globally(Vec::Unit(k)));
  };
  const auto on_axis = [&] { rows.push_back(now.apart(0)), rows.push_back(now.apart(1)); };
  const auto parallel = [&] { rows.push_back(now.cosine(0, 2)), rows.push_back(now.cosine(1, 2)); };
  switch (joint.kind) {
    case JointKind::spherical:
      return together();
    case JointKind::revolute:
      return together(), parallel();
    case JointKind::cylindrical:
      return on_axis(), parallel();
    case JointKind::planar:
      return rows.push_back(now.apart(2)), parallel();
    case JointKind::universal:
      return together(), rows.push_back(now.cosine(2, 2));
    case JointKind::translational:
      return on_axis(), parallel(), rows.push_back(now.cosine(0, 1));
    case JointKind::locking:
      return together(), parallel(), rows.push_back(now.cosine(0, 1));
    case JointKind::screw: {
      on_axis(), parallel();
      JointRow row = now.apart(2);
      const Vec e = now.axes_a.col(2);
      row.c -= joint.advance * turn_of(joint, a, b, joint.turned);
      row.w_a += joint.advance * e, row.w_b -= joint.advance * e;
      return rows.push_back(row);
    }
  }
}

Real turn_of(const Joint& joint, const BodyPose& a, const BodyPose& b, Real near) {
  const PlacedJoint now(joint, a, b);
  const Vec t1 = now.axes_b.col(0);
  const Real angle = std::atan2(t1.dot(Vec(now.axes_a.col(1))), t1.dot(Vec(now.axes_a.col(0))));
  return angle + 2 * pi * std::round((near - angle) / (2 * pi));
}

}  // namespace courant
