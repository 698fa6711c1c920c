#pragma once
// What a joint asks of two bodies, as equations c = 0 and how c changes as they move.
#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "base/real.hpp"
#include "rigid/rigid.hpp"

namespace courant {

enum class JointKind { spherical, revolute, cylindrical, planar, universal, translational, locking, screw };

/// How many pairs of nodes define a joint: of the first they are at one place at t = 0, and of the others,
/// too, unless the joint is universal.
std::size_t pairs_of(JointKind kind);
/// How many equations a joint is.
std::size_t rows_of(JointKind kind);
const char* joint_name(JointKind kind);

/// A joint between bodies A (odd nodes) and B (even nodes), in the axes of each at t = 0, about its centre.
struct Joint {
  Id id = 0;
  std::string title;
  JointKind kind = JointKind::spherical;
  std::size_t a = 0, b = 0;                    ///< bodies
  Vec at_a = Vec::Zero(), at_b = Vec::Zero();  ///< the joint's place in each [L]
  /// Columns: t1, t2 across the axis, the axis e. Of A and of B: one direction at t = 0, but for the axes of
  /// a universal joint.
  Matrix axes_a = Matrix::Identity(), axes_b = Matrix::Identity();
  Real advance = 0;  ///< screw: of B along the axis while it turns by 1, both as seen from A [L]
  Real turned = 0;   ///< screw: how far B has turned about the axis, as seen from A [-]
};

/// One equation: dc/dt = v_a.(velocity of A's centre) + w_a.(angular velocity of A) + the same of B.
struct JointRow {
  Real c = 0;  ///< [L], or [-] for angles
  Vec v_a = Vec::Zero(), w_a = Vec::Zero(), v_b = Vec::Zero(), w_b = Vec::Zero();
};

/// Adds the rows of a joint where its bodies are at `a` and `b`.
void add_rows(const Joint& joint, const BodyPose& a, const BodyPose& b, std::vector<JointRow>& rows);

/// How a body moves over a step.
struct BodyStep {
  Vec way = Vec::Zero();    ///< of its centre [L]
  Vec angle = Vec::Zero();  ///< about this axis, by its length [-]
};
/// Adds by how much c of each row changes over a step from `a` and `b`: to round-off of the changes, which
/// may be far less than that of c.
void add_changes(const Joint& joint, const BodyPose& a, const BodyPose& b, const BodyStep& step_a,
                 const BodyStep& step_b, std::vector<Real>& changes);

/// Angle by which B has turned about the joint's axis, as seen from A, next to `near`. [-]
Real turn_of(const Joint& joint, const BodyPose& a, const BodyPose& b, Real near);

}  // namespace courant
