// Tables of initial conditions, constraints and loads.
#include <cmath>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

using namespace rules;

const FieldRules local_system{.honour = Honour::no, .refers = IdSpace::coordinate_system};
const FieldRules system_id{.check = Check::not_negative, .refers = IdSpace::coordinate_system};
const FieldRules flag{.allowed = {0, 1}};

using V = InitialVelocityCard;
std::string move_velocities(V& card, const Affine& motion) {
  if (card.icid != 0) return {};  // along the axes of a system that moves
  std::string reason = move_velocity(card.vx, card.vy, card.vz, motion);
  return reason.empty() ? move_velocity(card.vxe, card.vye, card.vze, motion) : reason;
}
const RegisterKeyword<V> initial_velocity{
    {.names = {"INITIAL_VELOCITY"},
     .purpose = "initial velocity of a node set or of all nodes",
     .cards = {{.fields = {{"NSID", &V::nsid, "-", "node set id, 0 all nodes",
                            optional_id_of(IdSpace::node_set)},
                           {"NSIDEX", &V::nsidex, "-", "node set id of excepted nodes",
                            optional_id_of(IdSpace::node_set)},
                           {"BOXID", &V::boxid, "-", "only nodes in this box", optional_id_of(IdSpace::box)},
                           {"IRIGID", &V::irigid, "-", "overwrites PART_INERTIA velocities", unsupported},
                           {"ICID", &V::icid, "-", "system of the velocities, 0 global", system_id}}},
               {.fields = {{"VX", &V::vx, "L/T", "velocity in x"},
                           {"VY", &V::vy, "L/T", "velocity in y"},
                           {"VZ", &V::vz, "L/T", "velocity in z"},
                           {"VXR", &V::vxr, "1/T", "angular velocity about x", unsupported},
                           {"VYR", &V::vyr, "1/T", "angular velocity about y", unsupported},
                           {"VZR", &V::vzr, "1/T", "angular velocity about z", unsupported}}},
               {.fields = {{"VXE", &V::vxe, "L/T", "velocity in x of excepted nodes"},
                           {"VYE", &V::vye, "L/T", "velocity in y of excepted nodes"},
                           {"VZE", &V::vze, "L/T", "velocity in z of excepted nodes"},
                           {"VXRE", &V::vxre, "1/T", "angular velocity about x", unsupported},
                           {"VYRE", &V::vyre, "1/T", "angular velocity about y", unsupported},
                           {"VZRE", &V::vzre, "1/T", "angular velocity about z", unsupported}},
                .when = [](const V& card) { return card.nsidex > 0; }}},
     .move = move_velocities}};

using VN = InitialVelocityNodeCard;
const RegisterKeyword<VN> initial_velocity_node{
    {.names = {"INITIAL_VELOCITY_NODE"},
     .purpose = "initial velocity of single nodes; stands above the other INITIAL_VELOCITY keywords",
     .cards = {{.fields = {{"NID", &VN::nid, "-", "node id", required_id_of(IdSpace::node)},
                           {"VX", &VN::vx, "L/T", "velocity in x"},
                           {"VY", &VN::vy, "L/T", "velocity in y"},
                           {"VZ", &VN::vz, "L/T", "velocity in z"},
                           {"VXR", &VN::vxr, "1/T", "angular velocity about x", unsupported},
                           {"VYR", &VN::vyr, "1/T", "angular velocity about y", unsupported},
                           {"VZR", &VN::vzr, "1/T", "angular velocity about z", unsupported},
                           {"ICID", &VN::icid, "-", "system of the velocities, 0 global", system_id}}}},
     .move = [](VN& card, const Affine& motion) {
       return card.icid != 0 ? std::string() : move_velocity(card.vx, card.vy, card.vz, motion);
     }}};

using VG = InitialVelocityGenerationCard;
IdSpace kind_of_id(const VG& card) {
  return card.styp == 1 ? IdSpace::part_set : card.styp == 2 ? IdSpace::part : IdSpace::node_set;
}
std::string move_generation(VG& card, const Affine& motion) {
  constexpr Real axis_by_nodes = -999;
  if (card.icid != 0) return {};
  std::string reason = move_velocity(card.vx, card.vy, card.vz, motion);
  if (!reason.empty() || card.omega == 0) return reason;
  reason = refuse_stretch(motion, "velocities");
  if (!reason.empty()) return reason;
  if (card.nx != axis_by_nodes) {
    const Vec axis = motion.linear() * Vec(card.nx, card.ny, card.nz);
    card.nx = axis[0], card.ny = axis[1], card.nz = axis[2];
  }
  if (motion.linear().determinant() < 0) card.omega = -card.omega;  // in a mirror things turn the other way
  return {};
}
const RegisterKeyword<VG> initial_velocity_generation{
    {.names = {"INITIAL_VELOCITY_GENERATION"},
     .purpose = "initial velocity V + omega x r of parts or node sets",
     .cards = {{.fields = {{"ID",
                            &VG::id,
                            "-",
                            "id of the part set, part or node set, 0 all",
                            {.check = Check::not_negative},
                            kind_of_id},
                           {"STYP",
                            &VG::styp,
                            "-",
                            "kind of ID: 1 part set, 2 part, 3 node set",
                            {.standard = 1, .allowed = {1, 2, 3}}},
                           {"OMEGA", &VG::omega, "1/T", "angular velocity about the axis"},
                           {"VX", &VG::vx, "L/T", "velocity in x"},
                           {"VY", &VG::vy, "L/T", "velocity in y"},
                           {"VZ", &VG::vz, "L/T", "velocity in z"},
                           {"IVATN", &VG::ivatn, "-", "also constrained nodes and parts", no_effect},
                           {"ICID", &VG::icid, "-", "system of V and of the axis direction, 0 global",
                            system_id}}},
               {.fields = {{"XC", &VG::xc, "L", "x of a point on the axis", {.spatial = Spatial::point}},
                           {"YC", &VG::yc, "L", "y of a point on the axis"},
                           {"ZC", &VG::zc, "L", "z of a point on the axis"},
                           {"NX", &VG::nx, "-", "x of the axis direction"},
                           {"NY", &VG::ny, "-", "y of the axis direction"},
                           {"NZ", &VG::nz, "-", "z of the axis direction"},
                           {"PHASE",
                            &VG::phase,
                            "-",
                            "1 (and 0): behind a dynamic relaxation, where there is one",
                            {.allowed = {0, 1}}},
                           {"IRIGID", &VG::irigid, "-", "overwrites PART_INERTIA velocities", unsupported}}}},
     .move = move_generation}};

std::string move_constraint(BoundarySpcCard& card, const Affine& motion) {
  if (card.cid != 0) return {};                 // along the axes of a system that moves
  for (int* dof : {&card.dofx, &card.dofrx}) {  // three in a row
    int* flags[] = {dof, dof == &card.dofx ? &card.dofy : &card.dofry,
                    dof == &card.dofx ? &card.dofz : &card.dofrz};
    std::array<bool, 3> held{};
    for (std::size_t k = 0; k < 3; ++k) held[k] = *flags[k] == 1;
    std::string reason = move_held_axes(held, motion);
    if (!reason.empty() && dof == &card.dofx) return reason;
    for (std::size_t k = 0; k < 3; ++k) *flags[k] = held[k];
  }
  return {};
}

template <class T>
KeywordOf<T> boundary_spc(std::string name, std::string purpose, const char* field, const char* meaning,
                          IdSpace refers) {
  return {
      .names = {std::move(name)},
      .purpose = std::move(purpose),
      .id_space = IdSpace::boundary,
      .id_option = true,
      .title = &T::title,
      .id = &T::id,
      .cards = {{.fields = {{field, &T::nid, "-", meaning, required_id_of(refers)},
                            {"CID", &T::cid, "-", "system of the directions, 0 global", system_id},
                            {"DOFX", &T::dofx, "-", "1 holds the translation in x", flag},
                            {"DOFY", &T::dofy, "-", "1 holds the translation in y", flag},
                            {"DOFZ", &T::dofz, "-", "1 holds the translation in z", flag},
                            {"DOFRX", &T::dofrx, "-", "1 holds the rotation of shell nodes about x", flag},
                            {"DOFRY", &T::dofry, "-", "1 holds the rotation of shell nodes about y", flag},
                            {"DOFRZ", &T::dofrz, "-", "1 holds the rotation of shell nodes about z", flag}}}},
      .move = [](T& card, const Affine& motion) { return move_constraint(card, motion); }};
}
const RegisterKeyword<BoundarySpcNodeCard> boundary_spc_node{boundary_spc<BoundarySpcNodeCard>(
    "BOUNDARY_SPC_NODE", "holds translations of nodes", "NID", "node id", IdSpace::node)};
const RegisterKeyword<BoundarySpcSetCard> boundary_spc_set{boundary_spc<BoundarySpcSetCard>(
    "BOUNDARY_SPC_SET", "holds translations of node sets", "NSID", "node set id", IdSpace::node_set)};

template <class T>
CardOf<T> load_body_card(const char* curve, Honour centre) {
  return {.fields = {{"LCID", &T::lcid, "-", curve, required_id_of(IdSpace::curve)},
                     {"SF", &T::sf, "-", "scale of the curve", {.standard = 1}},
                     {"LCIDDR", &T::lciddr, "-", "curve for the dynamic relaxation, 0: LCID",
                      optional_id_of(IdSpace::curve)},
                     {"XC",
                      &T::xc,
                      "L",
                      "x of the centre of rotation",
                      {.honour = centre, .spatial = centre == Honour::yes ? Spatial::point : Spatial::none}},
                     {"YC", &T::yc, "L", "y of the centre of rotation", {.honour = centre}},
                     {"ZC", &T::zc, "L", "z of the centre of rotation", {.honour = centre}},
                     {"CID", &T::cid, "-", "coordinate system id", local_system}}};
}

using L = LoadBodyCard;
const RegisterKeyword<L> load_body{
    {.names = {"LOAD_BODY_X", "LOAD_BODY_Y", "LOAD_BODY_Z"},
     .purpose = "acceleration of the base along an axis: bodies feel the opposite (gravity along -z: "
                "LOAD_BODY_Z with +g)",
     .many = false,
     .cards = {load_body_card<L>("curve of acceleration over time", Honour::ignored)}}};

using LV = LoadBodyVectorCard;
const RegisterKeyword<LV> load_body_vector{
    {.names = {"LOAD_BODY_VECTOR"},
     .purpose = "acceleration of the base along a vector: bodies feel the opposite",
     .many = false,
     .cards = {load_body_card<LV>("curve of acceleration over time", Honour::ignored),
               {.fields = {{"V1", &LV::v1, "-", "direction of the acceleration, x", direction},
                           {"V2", &LV::v2, "-", "direction of the acceleration, y"},
                           {"V3", &LV::v3, "-", "direction of the acceleration, z"}}}}}};

using LR = LoadBodyRotationCard;
std::string move_rotation(LR& card, const Affine& motion) {
  const std::string reason = refuse_stretch(motion, "angular velocities");
  if (!reason.empty()) return reason;
  const Vec axis = Vec::Unit(card.name), turned = motion.linear() * axis;
  constexpr Real along = 1 - 1e-9;  // cosine; which way it points does not matter
  return std::abs(turned.dot(axis)) < along
             ? "the axis of the rotation would not be along the same global axis"
             : std::string();
}
const RegisterKeyword<LR> load_body_rotation{
    {.names = {"LOAD_BODY_RX", "LOAD_BODY_RY", "LOAD_BODY_RZ"},
     .purpose =
         "angular velocity of the base about an axis through XC, YC, ZC: bodies feel the centrifugal force",
     .many = false,
     .cards = {load_body_card<LR>("curve of angular velocity over time", Honour::yes)},
     .move = move_rotation}};

using LP = LoadBodyPartsCard;
const RegisterKeyword<LP> load_body_parts{
    {.names = {"LOAD_BODY_PARTS"},
     .purpose = "the parts on which all LOAD_BODY keywords act",
     .once = true,
     .many = false,
     .cards = {{.fields = {{"PSID", &LP::psid, "-", "part set id", required_id_of(IdSpace::part_set)}}}}}};

using LG = LoadGravityPartCard;
const RegisterKeyword<LG> load_gravity_part{
    {.names = {"LOAD_GRAVITY_PART", "LOAD_GRAVITY_PART_SET"},
     .purpose =
         "acceleration of the base under parts: bodies feel the opposite (gravity along -z: DOF 3, ACCEL "
         "with +g)",
     .cards = {
         {.fields = {{"PID",
                      &LG::pid,
                      "-",
                      "part id; _SET: part set id",
                      {.required = true, .check = Check::positive},
                      [](const LG& card) { return card.of_sets() ? IdSpace::part_set : IdSpace::part; }},
                     {"DOF",
                      &LG::dof,
                      "-",
                      "axis: 1 x, 2 y, 3 z",
                      {.required = true, .check = Check::positive, .allowed = {1, 2, 3}}},
                     {"LC", &LG::lc, "-", "curve of a factor over time; 0: 1 at all times",
                      optional_id_of(IdSpace::curve)},
                     {"ACCEL", &LG::accel, "L/T2", "acceleration, times that factor"},
                     {"LCDR", &LG::lcdr, "-", "curve for the dynamic relaxation, 0: LC",
                      optional_id_of(IdSpace::curve)},
                     {"STGA", &LG::stga, "-", "stage at which the part is added", unsupported},
                     {"STGR", &LG::stgr, "-", "stage at which it is removed", unsupported}}}}}};

}  // namespace

}  // namespace courant
