#pragma once
// Fields shared by folders that never include each other; they are described here only. One folder adds the
// field, and others respect it where it exists.
#include "state/field.hpp"

namespace courant {

template <class T>
class SharedField {
 public:
  explicit SharedField(FieldInfo info) : info_(std::move(info)) {}
  /// Registers it unless it is registered.
  Field<T>& add(FieldSet& set) const { return set.add<T>(info_); }
  /// nullptr: it is not registered.
  Field<T>* find(const FieldSet& set) const { return dynamic_cast<Field<T>*>(set.find(info_.name)); }

 private:
  FieldInfo info_;
};

namespace shared_fields {

/// Particles: 1 where a wall is within reach of contact, which marks it; the pass that adds the field clears
/// it when neighbours are refreshed.
inline const SharedField<Index> near_wall{{.name = "near_wall", .dimension = "-"}};
/// Points: axes along which SPC hold them, 1 x + 2 y + 4 z.
inline const SharedField<Index> held_axes{{.name = "fixed", .dimension = "-"}};
/// Points: != 0 where a prescribed motion drives them.
inline const SharedField<Index> prescribed_motion{{.name = "prescribed_motion", .dimension = "-"}};
/// Nodes: axes along which prescribed motions drive them in this step, 1 x + 2 y + 4 z; oblique motions count
/// along all axes of which they have a component.
inline const SharedField<Index> driven_axes{{.name = "driven_axes", .dimension = "-"}};
/// Points with a prescribed motion, for the coming step once its size is known: the projector on the
/// directions along which motions act, xx yy zz xy yz zx, and the change of velocity that they cause [L/T].
inline const SharedField<Real> driven_projector{
    {.name = "driven_projector", .dimension = "-", .components = 6}};
inline const SharedField<Real> driven_change{
    {.name = "driven_change", .dimension = "L/T", .components = 3, .restart = false}};
/// The same of rotations [1/T].
inline const SharedField<Real> driven_rotation_projector{
    {.name = "driven_rotation_projector", .dimension = "-", .components = 6}};
inline const SharedField<Real> driven_rotation_change{
    {.name = "driven_rotation_change", .dimension = "1/T", .components = 3, .restart = false}};
/// Particles: acceleration towards a mirror that is not reversed behind it, as it should be; passes that add
/// such a force record it here, except for gravity.
inline const SharedField<Real> mirror_pull{{.name = "mirror_pull", .dimension = "L/T2", .restart = false}};
/// Particles: the inlet where they wait or from which they came.
inline const SharedField<Index> inlet{{.name = "inlet", .dimension = "-"}};
/// Particles: m/RO, the reference volume of the internal energy.
inline const SharedField<Real> reference_volume{{.name = "reference_volume", .dimension = "L3"}};
/// Particles: stress beside the pressure, viscous and of strength: xx yy zz xy yz zx. Particles outside the
/// box keep their last active value.
inline const SharedField<Real> stress{
    {.name = "stress", .dimension = "M/LT2", .components = 6, .exchange = true}};
/// Rotations of nodes of deforming shells: angles about the axes so far, angular velocity, moment, and rotary
/// inertia, the same about all axes. Other nodes have none of these.
inline const SharedField<Real> rotation{
    {.name = "rotation", .dimension = "-", .components = 3, .output = true}};
inline const SharedField<Real> angular_velocity{
    {.name = "angular_velocity", .dimension = "1/T", .components = 3, .output = true}};
inline const SharedField<Real> moment{
    {.name = "moment", .dimension = "ML2/T2", .components = 3, .restart = false}};
inline const SharedField<Real> rotary_inertia{{.name = "rotary_inertia", .dimension = "ML2"}};
/// Nodes: moment with which SPC hold their rotations.
inline const SharedField<Real> support_moment{
    {.name = "support_moment", .dimension = "ML2/T2", .components = 3, .restart = false}};
/// Nodes: the part of their mass that mass scaling added [M].
inline const SharedField<Real> added_mass{{.name = "added_mass", .dimension = "M", .output = true}};
/// Elements and faces: 0 there, else one of the values below. Only where elements may fail.
inline const SharedField<Index> eroded{{.name = "eroded", .dimension = "-", .may_begin_later = true}};
inline constexpr Index deleted = 1;
inline constexpr Index hidden = 2;  ///< an inner face of solids, which deletion may expose
/// Faces of shells: thickness for contact. Only where it differs from that of the shells.
inline const SharedField<Real> contact_thickness{
    {.name = "contact_thickness", .dimension = "L", .restart = false}};
/// Nodes: 1 where moments do not rotate it: a rigid body rotates it, or it belongs to no deforming shell.
inline const SharedField<Index> no_rotation{{.name = "no_rotation", .dimension = "-"}};
/// As held_axes and prescribed_motion, of rotations.
inline const SharedField<Index> held_rotations{{.name = "held_rotations", .dimension = "-"}};
inline const SharedField<Index> prescribed_rotation{{.name = "prescribed_rotation", .dimension = "-"}};

}  // namespace shared_fields

}  // namespace courant
