#pragma once
// The conditions of a joint on two bodies, as equations c = 0 and the change of c as they move.
#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "base/real.hpp"
#include "rigid/bodies/rigid.hpp"
#include "rigid/joints/joint_drive.hpp"

namespace courant {

enum class JointKind {
  spherical,
  revolute,
  cylindrical,
  planar,
  universal,
  translational,
  locking,
  screw,
  rotational_motor,
  translational_motor,
  gears,
  rack_and_pinion,
  pulley
};

/// How many pairs of nodes define a joint: of the first they are at one position at t = 0, and of the others,
/// too, unless the joint is universal, a motor or a gear.
std::size_t pairs_of(JointKind kind);
/// Whether a curve states how far B turns or moves as seen from A.
constexpr bool is_motor(JointKind kind) {
  return kind == JointKind::rotational_motor || kind == JointKind::translational_motor;
}
/// Whether the axes of the two bodies are at different positions, and turns of one move the other.
constexpr bool is_gear(JointKind kind) {
  return kind == JointKind::gears || kind == JointKind::rack_and_pinion || kind == JointKind::pulley;
}
/// How many equations a joint is.
std::size_t rows_of(JointKind kind);
const char* joint_name(JointKind kind);

/// A joint between bodies A (odd nodes) and B (even nodes), in the axes of each at t = 0, about its centre.
struct Joint {
  Id id = 0;
  std::string title;
  JointKind kind = JointKind::spherical;
  std::size_t a = 0, b = 0;                    ///< bodies
  Vec at_a = Vec::Zero(), at_b = Vec::Zero();  ///< the joint's position in each [L]
  /// Columns: t1, t2 across the axis, the axis e. Of A and of B: one direction at t = 0, but for the axes of
  /// a universal joint and of gears.
  Matrix axes_a = Matrix::Identity(), axes_b = Matrix::Identity();
  /// Its equations are springs and dampers; scales of their stiffness and damping (0: none).
  bool yields = false;
  Real rps = 1, damp = 1;
  Real advance = 0;  ///< screw, rack: of B along the axis while it, or A, turns by 1 [L]
  /// screw, motor: how far B has turned about the axis, as seen from A [-]; gears: what round-off has left
  /// of their equation so far [-], [L]
  Real turned = 0;
  JointDrive drive;
  Real driven = 0, coming = 0;  ///< motor: the drive's until(t), over(t, dt)
  Real start = 0;               ///< translational motor: of B's position along the axis at t = 0 [L]
  Real ratio = 1, sense = 1;    ///< gears, pulley: R2/R1; 1 where both turn the same way, else -1 [-]
  bool carried = false;         ///< gears, pulley: axes are parallel, and turns count from their centre line
};

/// One equation: dc/dt = v_a.(velocity of A's centre) + w_a.(angular velocity of A) + the same of B.
struct JointRow {
  Real c = 0;  ///< [L], or [-] for angles
  Vec v_a = Vec::Zero(), w_a = Vec::Zero(), v_b = Vec::Zero(), w_b = Vec::Zero();
  bool angle = false;  ///< c is one, though places move, too
  bool is_length() const { return !angle && !v_a.isZero(0); }
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
