// Cards of joints between rigid bodies.
#include <cmath>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/transforms/transformation.hpp"
#include "rigid/joint_cards.hpp"

namespace courant {

namespace {

using J = JointCard;
constexpr FieldRules joint_node = rules::optional_id_of(IdSpace::node);
constexpr FieldRules exact{.standard = 1, .honour = Honour::ignored};

bool has_pitch(const J& j) {
  return j.kind() == JointKind::screw || j.kind() == JointKind::rack_and_pinion;
}
bool moved_by_curve(const J& j) {
  return is_motor(j.kind());
}
bool has_ratio(const J& j) {
  return j.kind() == JointKind::gears || j.kind() == JointKind::pulley;
}

/// A helix that is mirrored turns the other way, as a motor does; its pitch is a length.
std::string move_joint(J& joint, const Affine& motion) {
  if (joint.kind() == JointKind::translational_motor) return refuse_stretch(motion, "motors");
  if (motion.linear().determinant() < 0) joint.sense = -joint.sense;
  if (!has_pitch(joint)) return {};
  constexpr Real round_off = 1e-9;
  const Matrix A = motion.linear(), stretch = A.transpose() * A;
  const Real scale = std::cbrt(A.determinant());
  if (joint.parm != 0 && (stretch - scale * scale * Matrix::Identity()).norm() > round_off * scale * scale)
    return "the pitch of a screw or rack has no direction in a transformation that stretches the file "
           "unevenly";
  joint.parm *= scale;
  return {};
}

const RegisterKeyword<J> joint_keyword{
    {.names = {"CONSTRAINED_JOINT_SPHERICAL", "CONSTRAINED_JOINT_REVOLUTE", "CONSTRAINED_JOINT_CYLINDRICAL",
               "CONSTRAINED_JOINT_PLANAR", "CONSTRAINED_JOINT_UNIVERSAL", "CONSTRAINED_JOINT_TRANSLATIONAL",
               "CONSTRAINED_JOINT_LOCKING", "CONSTRAINED_JOINT_SCREW", "CONSTRAINED_JOINT_ROTATIONAL_MOTOR",
               "CONSTRAINED_JOINT_TRANSLATIONAL_MOTOR", "CONSTRAINED_JOINT_GEARS",
               "CONSTRAINED_JOINT_RACK_AND_PINION", "CONSTRAINED_JOINT_PULLEY"},
     .purpose = "joint between two rigid bodies, of which odd nodes belong to one, even nodes to the other",
     .id_space = IdSpace::joint,
     .id_option = true,
     .title = &J::title,
     .id = &J::id,
     .cards =
         {{.fields = {{"N1", &J::n1, "-", "node of the first body, where the joint is",
                       rules::required_id_of(IdSpace::node)},
                      {"N2", &J::n2, "-", "node of the second body, at the same place",
                       rules::required_id_of(IdSpace::node)},
                      {"N3", &J::n3, "-", "node of the first body: N1 to N3 is the axis", joint_node},
                      {"N4", &J::n4, "-",
                       "node of the second body at the place of N3; universal: N2 to N4 is the other axis",
                       joint_node},
                      {"N5", &J::n5, "-", "node of the first body beside the axis", joint_node},
                      {"N6", &J::n6, "-", "node of the second body at the place of N5", joint_node},
                      {"RPS", &J::rps, "-", "relative stiffness: joints hold exactly here", exact},
                      {"DAMP", &J::damp, "-", "scale of damping: joints hold exactly here", exact}}},
          {.fields =
               {{"PARM", &J::parm, "L",
                 "screw, rack: advance along the axis for a turn by one radian; gears, pulleys: R2/R1"},
                {"LCID", &J::lcid, "-", "curve of a motor", {.honour = Honour::no, .refers = IdSpace::curve}},
                {"TYPE", &J::type, "-", "kind of a motor", unsupported},
                {"R1", &J::r1, "L", "radius of gears", unsupported}},
           .when = has_pitch},
          {.fields = {{"PARM", &J::parm, "-", "of no meaning for motors", no_effect},
                      {"LCID", &J::lcid, "-",
                       "curve over time of how the second body turns (radians), or moves, about or along N1 "
                       "to N3 as seen from the first one",
                       rules::required_id_of(IdSpace::curve)},
                      {"TYPE",
                       &J::type,
                       "-",
                       "the curve has: 0 velocities, 1 accelerations, 2 displacements",
                       {.allowed = {0, 1, 2}}},
                      {"R1", &J::r1, "L", "of no meaning for motors", no_effect}},
           .when = moved_by_curve},
          {.fields =
               {{"PARM", &J::parm, "-", "R2/R1, how many times as fast the first body turns"},
                {"LCID", &J::lcid, "-", "curve of a motor", {.honour = Honour::no, .refers = IdSpace::curve}},
                {"TYPE", &J::type, "-", "kind of a motor", unsupported},
                {"R1", &J::r1, "L", "radius by which LS-DYNA tells forces: jntforc tells moments here",
                 no_effect},
                {"H_ANGLE", &J::h_angle, "-", "helix angle of worm gears, degrees", unsupported}},
           .when = has_ratio}},
     .move = move_joint}};

}  // namespace

}  // namespace courant
