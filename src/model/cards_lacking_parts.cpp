// Elements, parts and constraints whose physics is not here: their cards are read and checked, and the deck
// is refused by name.
#include <string>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

using namespace rules;

namespace {

struct ElementShellThickness : Entry {
  Id eid = 0, pid = 0, n1 = 0, n2 = 0, n3 = 0, n4 = 0, n5 = 0, n6 = 0, n7 = 0, n8 = 0;
  Real thic1 = 0, thic2 = 0, thic3 = 0, thic4 = 0, beta = 0, thic5 = 0, thic6 = 0, thic7 = 0, thic8 = 0,
       offset = 0;
};
KeywordOf<ElementShellThickness> element_shell_thickness() {
  using T = ElementShellThickness;
  return {
      .names = {"ELEMENT_SHELL_THICKNESS", "ELEMENT_SHELL_BETA", "ELEMENT_SHELL_MCID", "ELEMENT_SHELL_OFFSET",
                "ELEMENT_SHELL_THICKNESS_OFFSET", "ELEMENT_SHELL_BETA_OFFSET"},
      .purpose = "shells with thicknesses, angles or offsets of their own",
      .id_space = IdSpace::shell,
      .lacking = "thicknesses, angles and offsets of single shells",
      .cards = {
          {.fields =
               {{"EID", &T::eid, "-", "element id", {.required = true, .check = Check::positive, .width = 8}},
                {"PID", &T::pid, "-", "part id", {.width = 8, .refers = IdSpace::part}},
                {"N1", &T::n1, "-", "corner node", {.width = 8, .refers = IdSpace::node}},
                {"N2", &T::n2, "-", "corner node", {.width = 8, .refers = IdSpace::node}},
                {"N3", &T::n3, "-", "corner node", {.width = 8, .refers = IdSpace::node}},
                {"N4", &T::n4, "-", "corner node", {.width = 8, .refers = IdSpace::node}},
                {"N5", &T::n5, "-", "mid-side node", {.width = 8, .refers = IdSpace::node}},
                {"N6", &T::n6, "-", "mid-side node", {.width = 8, .refers = IdSpace::node}},
                {"N7", &T::n7, "-", "mid-side node", {.width = 8, .refers = IdSpace::node}},
                {"N8", &T::n8, "-", "mid-side node", {.width = 8, .refers = IdSpace::node}}}},
          {.fields = {{"THIC1", &T::thic1, "L", "thickness at corner 1", {.width = 16}},
                      {"THIC2", &T::thic2, "L", "thickness at corner 2", {.width = 16}},
                      {"THIC3", &T::thic3, "L", "thickness at corner 3", {.width = 16}},
                      {"THIC4", &T::thic4, "L", "thickness at corner 4", {.width = 16}},
                      {"BETA",
                       &T::beta,
                       "-",
                       "angle of the material; with _MCID its coordinate system",
                       {.width = 16}}},
           .when = [](const T& e) { return e.name != 3; }},
          {.fields = {{"THIC5", &T::thic5, "L", "thickness at mid-side node 5", {.width = 16}},
                      {"THIC6", &T::thic6, "L", "thickness at mid-side node 6", {.width = 16}},
                      {"THIC7", &T::thic7, "L", "thickness at mid-side node 7", {.width = 16}},
                      {"THIC8", &T::thic8, "L", "thickness at mid-side node 8", {.width = 16}}},
           .when = [](const T& e) { return e.name != 3 && e.n5 != 0; }},
          {.fields =
               {{"OFFSET", &T::offset, "L", "offset of the middle surface from the nodes", {.width = 16}}},
           .when = [](const T& e) { return e.name >= 3; }}}};
}
const RegisterKeyword<ElementShellThickness> element_shell_thickness_keyword{element_shell_thickness()};

struct ElementBeam : Entry {
  Id eid = 0, pid = 0, n1 = 0, n2 = 0, n3 = 0, pid1 = 0, pid2 = 0;
  int rt1 = 0, rr1 = 0, rt2 = 0, rr2 = 0, local = 0;
  Real parm1 = 0, parm2 = 0, parm3 = 0, parm4 = 0, parm5 = 0, vx = 0, vy = 0, vz = 0;
};
KeywordOf<ElementBeam> element_beam() {
  using T = ElementBeam;
  return {
      .names = {"ELEMENT_BEAM", "ELEMENT_BEAM_THICKNESS", "ELEMENT_BEAM_ORIENTATION", "ELEMENT_BEAM_PID"},
      .purpose = "beams; options add a card",
      .id_space = IdSpace::beam,
      .lacking = "beam elements",
      .cards = {
          {.fields =
               {{"EID", &T::eid, "-", "element id", {.required = true, .check = Check::positive, .width = 8}},
                {"PID", &T::pid, "-", "part id", {.width = 8, .refers = IdSpace::part}},
                {"N1", &T::n1, "-", "end node 1", {.width = 8, .refers = IdSpace::node}},
                {"N2", &T::n2, "-", "end node 2", {.width = 8, .refers = IdSpace::node}},
                {"N3", &T::n3, "-", "node of the orientation", {.width = 8, .refers = IdSpace::node}},
                {"RT1", &T::rt1, "-", "released translations at end 1", {.width = 8}},
                {"RR1", &T::rr1, "-", "released rotations at end 1", {.width = 8}},
                {"RT2", &T::rt2, "-", "released translations at end 2", {.width = 8}},
                {"RR2", &T::rr2, "-", "released rotations at end 2", {.width = 8}},
                {"LOCAL", &T::local, "-", "system of the releases", {.width = 8}}}},
          {.fields = {{"PARM1", &T::parm1, "-", "measure 1 of the cross-section", {.width = 16}},
                      {"PARM2", &T::parm2, "-", "measure 2 of the cross-section", {.width = 16}},
                      {"PARM3", &T::parm3, "-", "measure 3 of the cross-section", {.width = 16}},
                      {"PARM4", &T::parm4, "-", "measure 4 of the cross-section", {.width = 16}},
                      {"PARM5", &T::parm5, "-", "measure 5 of the cross-section", {.width = 16}}},
           .when = [](const T& e) { return e.name == 1; }},
          {.fields = {{"VX", &T::vx, "-", "orientation, x", {.width = 16, .spatial = Spatial::direction}},
                      {"VY", &T::vy, "-", "orientation, y", {.width = 16}},
                      {"VZ", &T::vz, "-", "orientation, z", {.width = 16}}},
           .when = [](const T& e) { return e.name == 2; }},
          {.fields = {{"PID1", &T::pid1, "-", "part at end 1", {.width = 8, .refers = IdSpace::part}},
                      {"PID2", &T::pid2, "-", "part at end 2", {.width = 8, .refers = IdSpace::part}}},
           .when = [](const T& e) { return e.name == 3; }}}};
}
const RegisterKeyword<ElementBeam> element_beam_keyword{element_beam()};

struct SectionBeam : Entry {
  std::string title;
  Id secid = 0;
  int elform = 0;
  Real shrf = 0, qr_irid = 0, cst = 0, scoor = 0, nsm = 0, ts1 = 0, ts2 = 0, tt1 = 0, tt2 = 0, nsloc = 0,
       ntloc = 0;
};
KeywordOf<SectionBeam> section_beam() {
  using T = SectionBeam;
  return {.names = {"SECTION_BEAM"},
          .purpose = "cross-sections of beams",
          .id_space = IdSpace::section,
          .title_option = true,
          .title = &T::title,
          .lacking = "sections of beam elements",
          .cards = {{.fields = {{"SECID", &T::secid, "-", "id that *PART refers to", required_id},
                                {"ELFORM", &T::elform, "-", "formulation", or_blank(1)},
                                {"SHRF", &T::shrf, "-", "shear factor", or_blank(1)},
                                {"QR/IRID", &T::qr_irid, "-", "quadrature rule", or_blank(2)},
                                {"CST", &T::cst, "-", "kind of cross-section"},
                                {"SCOOR", &T::scoor, "-", "place of the triad"},
                                {"NSM", &T::nsm, "M/L", "mass per length besides the material's"}}},
                    {.fields = {{"TS1", &T::ts1, "-", "first measure of the cross-section"},
                                {"TS2", &T::ts2, "-", "second measure"},
                                {"TT1", &T::tt1, "-", "third measure"},
                                {"TT2", &T::tt2, "-", "fourth measure"},
                                {"NSLOC", &T::nsloc, "-", "place of the axis s"},
                                {"NTLOC", &T::ntloc, "-", "place of the axis t"}}}}};
}
const RegisterKeyword<SectionBeam> section_beam_keyword{section_beam()};

struct ElementDiscrete : Entry {
  Id eid = 0, pid = 0, n1 = 0, n2 = 0, vid = 0;
  int pf = 0;
  Real s = 0, offset = 0;
};
KeywordOf<ElementDiscrete> element_discrete() {
  using T = ElementDiscrete;
  return {
      .names = {"ELEMENT_DISCRETE"},
      .purpose = "springs and dampers",
      .id_space = IdSpace::discrete,
      .lacking = "springs and dampers",
      .cards = {
          {.fields = {
               {"EID", &T::eid, "-", "element id", {.required = true, .check = Check::positive, .width = 8}},
               {"PID", &T::pid, "-", "part id", {.width = 8, .refers = IdSpace::part}},
               {"N1", &T::n1, "-", "end node 1", {.width = 8, .refers = IdSpace::node}},
               {"N2", &T::n2, "-", "end node 2, 0: fixed in space", {.width = 8, .refers = IdSpace::node}},
               {"VID", &T::vid, "-", "orientation", {.width = 8, .refers = IdSpace::vector}},
               {"S", &T::s, "-", "scale of the force", {.standard = 1, .width = 16}},
               {"PF", &T::pf, "-", "print flag", {.width = 8}},
               {"OFFSET", &T::offset, "L", "initial offset", {.width = 16}}}}}};
}
const RegisterKeyword<ElementDiscrete> element_discrete_keyword{element_discrete()};

struct ElementInertia : Entry {
  Id eid = 0, nid = 0, csid = 0;
  Real ixx = 0, ixy = 0, ixz = 0, iyy = 0, iyz = 0, izz = 0, mass = 0;
};
KeywordOf<ElementInertia> element_inertia() {
  using T = ElementInertia;
  return {
      .names = {"ELEMENT_INERTIA"},
      .purpose = "mass and inertia on a node",
      .id_space = IdSpace::mass,
      .lacking = "masses on nodes",
      .cards = {
          {.fields =
               {{"EID", &T::eid, "-", "element id", {.required = true, .check = Check::positive, .width = 8}},
                {"NID", &T::nid, "-", "node", {.width = 8, .refers = IdSpace::node}},
                {"CSID",
                 &T::csid,
                 "-",
                 "system of the inertia",
                 {.width = 8, .refers = IdSpace::coordinate_system}}}},
          {.fields = {{"IXX", &T::ixx, "ML2", "inertia"},
                      {"IXY", &T::ixy, "ML2", "inertia"},
                      {"IXZ", &T::ixz, "ML2", "inertia"},
                      {"IYY", &T::iyy, "ML2", "inertia"},
                      {"IYZ", &T::iyz, "ML2", "inertia"},
                      {"IZZ", &T::izz, "ML2", "inertia"},
                      {"MASS", &T::mass, "M", "mass"}}}}};
}
const RegisterKeyword<ElementInertia> element_inertia_keyword{element_inertia()};

struct PartInertia : Entry {
  std::string title;
  Id pid = 0, secid = 0, mid = 0, eosid = 0, hgid = 0, tmid = 0, nodeid = 0, cid = 0;
  int grav = 0, adpopt = 0, ircs = 0;
  Real xc = 0, yc = 0, zc = 0, tm = 0, ixx = 0, ixy = 0, ixz = 0, iyy = 0, iyz = 0, izz = 0, vtx = 0, vty = 0,
       vtz = 0, vrx = 0, vry = 0, vrz = 0, xl = 0, yl = 0, zl = 0, xlip = 0, ylip = 0, zlip = 0;
};
KeywordOf<PartInertia> part_inertia() {
  using T = PartInertia;
  return {
      .names = {"PART_INERTIA"},
      .purpose = "rigid part whose mass and inertia are given",
      .id_space = IdSpace::part,
      .heading = true,
      .title = &T::title,
      .lacking = "masses and inertias of parts that are given",
      .cards = {
          {.fields = {{"PID", &T::pid, "-", "part id", required_id},
                      {"SECID", &T::secid, "-", "section id", id_of(IdSpace::section)},
                      {"MID", &T::mid, "-", "material id", id_of(IdSpace::material)},
                      {"EOSID", &T::eosid, "-", "equation of state id (solids, SPH)", id_of(IdSpace::eos)},
                      {"HGID", &T::hgid, "-", "*HOURGLASS id, 0 = global defaults",
                       id_of(IdSpace::hourglass)},
                      {"GRAV", &T::grav, "-", "1 initialise only this part with gravity preload"},
                      {"ADPOPT", &T::adpopt, "-", "adaptivity flag, 0 off"},
                      {"TMID", &T::tmid, "-", "thermal material id", id_of(IdSpace::material)}}},
          {.fields = {{"XC", &T::xc, "L", "centre-of-mass coordinate (ignored if NODEID given)", point},
                      {"YC", &T::yc, "L", "centre-of-mass coordinate (ignored if NODEID given)"},
                      {"ZC", &T::zc, "L", "centre-of-mass coordinate (ignored if NODEID given)"},
                      {"TM", &T::tm, "M", "translational mass"},
                      {"IRCS", &T::ircs, "-", "0 global inertia tensor; 1 local axes given"},
                      {"NODEID", &T::nodeid, "-", "node that locates the centre of mass",
                       id_of(IdSpace::node)}}},
          {.fields = {{"IXX", &T::ixx, "ML2", "inertia tensor component"},
                      {"IXY", &T::ixy, "ML2", "inertia tensor component"},
                      {"IXZ", &T::ixz, "ML2", "inertia tensor component"},
                      {"IYY", &T::iyy, "ML2", "inertia tensor component"},
                      {"IYZ", &T::iyz, "ML2", "inertia tensor component"},
                      {"IZZ", &T::izz, "ML2", "inertia tensor component"}}},
          {.fields = {{"VTX", &T::vtx, "L/T", "initial translational velocity, global", direction},
                      {"VTY", &T::vty, "L/T", "initial translational velocity, global"},
                      {"VTZ", &T::vtz, "L/T", "initial translational velocity, global"},
                      {"VRX", &T::vrx, "1/T", "initial rotational velocity, global", direction},
                      {"VRY", &T::vry, "1/T", "initial rotational velocity, global"},
                      {"VRZ", &T::vrz, "1/T", "initial rotational velocity, global"}}},
          {.fields = {{"XL", &T::xl, "L", "point on local x axis", point},
                      {"YL", &T::yl, "L", "point on local x axis"},
                      {"ZL", &T::zl, "L", "point on local x axis"},
                      {"XLIP", &T::xlip, "L", "point in local xy plane", point},
                      {"YLIP", &T::ylip, "L", "point in local xy plane"},
                      {"ZLIP", &T::zlip, "L", "point in local xy plane"},
                      {"CID", &T::cid, "-", "local system instead of the six values",
                       id_of(IdSpace::coordinate_system)}},
           .when = [](const T& e) { return e.ircs == 1; }}}};
}
const RegisterKeyword<PartInertia> part_inertia_keyword{part_inertia()};

struct ConstrainedExtraNodesNode : Entry {
  Id pid = 0, nid = 0;
  int iflag = 0;
};
KeywordOf<ConstrainedExtraNodesNode> constrained_extra_nodes_node() {
  using T = ConstrainedExtraNodesNode;
  return {.names = {"CONSTRAINED_EXTRA_NODES_NODE"},
          .purpose = "nodes added to a rigid body",
          .lacking = "nodes added to rigid bodies",
          .cards = {{.fields = {{"PID", &T::pid, "-", "rigid part that takes the nodes",
                                 required_id_of(IdSpace::part)},
                                {"NID", &T::nid, "-", "node to add", id_of(IdSpace::node)},
                                {"IFLAG", &T::iflag, "-", "1 update *PART_INERTIA mass, inertia"}}}}};
}
const RegisterKeyword<ConstrainedExtraNodesNode> constrained_extra_nodes_node_keyword{
    constrained_extra_nodes_node()};

struct ConstrainedExtraNodesSet : Entry {
  Id pid = 0, nsid = 0;
  int iflag = 0;
};
KeywordOf<ConstrainedExtraNodesSet> constrained_extra_nodes_set() {
  using T = ConstrainedExtraNodesSet;
  return {
      .names = {"CONSTRAINED_EXTRA_NODES_SET"},
      .purpose = "node sets added to a rigid body",
      .lacking = "nodes added to rigid bodies",
      .cards = {
          {.fields = {{"PID", &T::pid, "-", "rigid part that takes the nodes", required_id_of(IdSpace::part)},
                      {"NSID", &T::nsid, "-", "node set", id_of(IdSpace::node_set)},
                      {"IFLAG", &T::iflag, "-", "1 updates the mass and inertia of *PART_INERTIA"}}}}};
}
const RegisterKeyword<ConstrainedExtraNodesSet> constrained_extra_nodes_set_keyword{
    constrained_extra_nodes_set()};

struct ConstrainedRigidBodies : Entry {
  Id pidl = 0, pidc = 0;
  int iflag = 0;
};
KeywordOf<ConstrainedRigidBodies> constrained_rigid_bodies() {
  using T = ConstrainedRigidBodies;
  return {
      .names = {"CONSTRAINED_RIGID_BODIES"},
      .purpose = "rigid parts that move as one",
      .lacking = "merged rigid bodies",
      .cards = {{.fields = {{"PIDL", &T::pidl, "-", "lead part (old PIDM)", required_id_of(IdSpace::part)},
                            {"PIDC", &T::pidc, "-", "part merged into it (old PIDS)", id_of(IdSpace::part)},
                            {"IFLAG", &T::iflag, "-", "1 merge properties even with *PART_INERTIA"}}}}};
}
const RegisterKeyword<ConstrainedRigidBodies> constrained_rigid_bodies_keyword{constrained_rigid_bodies()};

struct ConstrainedNodalRigidBody : Entry {
  std::string title;
  Id pid = 0, cid = 0, nsid = 0, pnode = 0;
  int iprt = 0, drflag = 0, rrflag = 0;
};
KeywordOf<ConstrainedNodalRigidBody> constrained_nodal_rigid_body() {
  using T = ConstrainedNodalRigidBody;
  return {
      .names = {"CONSTRAINED_NODAL_RIGID_BODY"},
      .purpose = "nodes that move as one rigid body",
      .id_space = IdSpace::part,
      .title_option = true,
      .title = &T::title,
      .lacking = "rigid bodies of nodes",
      .cards = {{.fields = {{"PID", &T::pid, "-", "id of the body, among the parts", required_id},
                            {"CID", &T::cid, "-", "system of the output", id_of(IdSpace::coordinate_system)},
                            {"NSID", &T::nsid, "-", "node set", id_of(IdSpace::node_set)},
                            {"PNODE", &T::pnode, "-", "node for output", id_of(IdSpace::node)},
                            {"IPRT", &T::iprt, "-", "print flag"},
                            {"DRFLAG", &T::drflag, "-", "released translations"},
                            {"RRFLAG", &T::rrflag, "-", "released rotations"}}}}};
}
const RegisterKeyword<ConstrainedNodalRigidBody> constrained_nodal_rigid_body_keyword{
    constrained_nodal_rigid_body()};

}  // namespace

}  // namespace courant
