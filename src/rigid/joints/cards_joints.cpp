// Cards of joints between rigid bodies.
#include <cmath>

#include "keyword/registry.hpp"
#include "model/conditions/prescribed_motion.hpp"
#include "model/transforms/transformation.hpp"
#include "rigid/joints/joint_cards.hpp"

namespace courant {

namespace {

const RegisterKeyword<JointCard> joint_keyword{constrained_joint_spherical_table()};
const RegisterKeyword<ControlRigid> control_keyword{control_rigid_table()};

}  // namespace

CurveOf curve_of_motor(const JointCardFields& fields) {
  const auto& joint = static_cast<const JointCard&>(fields);
  return curve_of_drive(joint.type, joint.kind() == JointKind::rotational_motor);
}

/// A helix that is mirrored turns the other way, as a motor does; its pitch is a length.
std::string move_joint(JointCardFields& fields, const Affine& motion) {
  auto& joint = static_cast<JointCard&>(fields);
  if (joint.kind() == JointKind::translational_motor) return refuse_stretch(motion, "motors");
  if (motion.linear().determinant() < 0) joint.sense = -joint.sense;
  if (joint.kind() != JointKind::screw && joint.kind() != JointKind::rack_and_pinion) return {};
  constexpr Real round_off = 1e-9;
  const Matrix A = motion.linear(), stretch = A.transpose() * A;
  const Real scale = std::cbrt(A.determinant());
  if (joint.parm != 0 && (stretch - scale * scale * Matrix::Identity()).norm() > round_off * scale * scale)
    return "the pitch of a screw or rack has no direction in a transformation that stretches the file "
           "unevenly";
  joint.parm *= scale;
  return {};
}

}  // namespace courant
