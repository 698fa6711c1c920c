// Initial velocities, loads and walls whose physics is not here: their cards are read and
// checked, and the deck is refused by name.
#include <string>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

using namespace rules;

namespace {

struct InitialVelocityRigidBody : Entry {
  Id pid = 0, icid = 0;
  Real vx = 0, vy = 0, vz = 0, vxr = 0, vyr = 0, vzr = 0;
};
KeywordOf<InitialVelocityRigidBody> initial_velocity_rigid_body() {
  using T = InitialVelocityRigidBody;
  return {.names = {"INITIAL_VELOCITY_RIGID_BODY"},
          .purpose = "initial velocity of rigid bodies",
          .lacking = "initial velocities of rigid bodies",
          .cards = {{.fields = {{"PID", &T::pid, "-", "rigid part", required_id_of(IdSpace::part)},
                                {"VX", &T::vx, "L/T", "translational velocity component", direction},
                                {"VY", &T::vy, "L/T", "translational velocity component"},
                                {"VZ", &T::vz, "L/T", "translational velocity component"},
                                {"VXR", &T::vxr, "1/T", "rotational velocity component", direction},
                                {"VYR", &T::vyr, "1/T", "rotational velocity component"},
                                {"VZR", &T::vzr, "1/T", "rotational velocity component"},
                                {"ICID", &T::icid, "-", "local coordinate system for the values",
                                 id_of(IdSpace::coordinate_system)}}}}};
}
const RegisterKeyword<InitialVelocityRigidBody> initial_velocity_rigid_body_keyword{
    initial_velocity_rigid_body()};

struct LoadRigidBody : Entry {
  Id pid = 0, lcid = 0, cid = 0, m1 = 0, m2 = 0, m3 = 0;
  int dof = 0;
  Real sf = 0;
};
KeywordOf<LoadRigidBody> load_rigid_body() {
  using T = LoadRigidBody;
  return {
      .names = {"LOAD_RIGID_BODY"},
      .purpose = "force or moment at the centre of a rigid body",
      .lacking = "forces on rigid bodies",
      .cards = {
          {.fields = {
               {"PID", &T::pid, "-", "rigid part", required_id_of(IdSpace::part)},
               {"DOF", &T::dof, "-", "1-3 force, 4 follower, 5-7 moment, 8 follower", or_blank(1)},
               {"LCID", &T::lcid, "-", "curve of time; <0: of |displacement|", id_of(IdSpace::curve)},
               {"SF", &T::sf, "-", "curve scale factor", or_blank(1)},
               {"CID", &T::cid, "-", "coordinate system id (0 = global)", id_of(IdSpace::coordinate_system)},
               {"M1", &T::m1, "-", "nodes for follower direction", id_of(IdSpace::node)},
               {"M2", &T::m2, "-", "nodes for follower direction", id_of(IdSpace::node)},
               {"M3", &T::m3, "-", "nodes for follower direction", id_of(IdSpace::node)}}}}};
}
const RegisterKeyword<LoadRigidBody> load_rigid_body_keyword{load_rigid_body()};

struct LoadSegment : Entry {
  std::string title;
  Id entry_id = 0;
  Id lcid = 0, n1 = 0, n2 = 0, n3 = 0, n4 = 0, n5 = 0, n6 = 0, n7 = 0, n8 = 0;
  Real sf = 0, at = 0;
};
KeywordOf<LoadSegment> load_segment() {
  using T = LoadSegment;
  return {.names = {"LOAD_SEGMENT"},
          .purpose = "pressure on segments",
          .id_space = IdSpace::definition,
          .id_option = true,
          .title = &T::title,
          .id = &T::entry_id,
          .lacking = "pressures on segments",
          .cards = {{.fields = {{"LCID", &T::lcid, "-", "curve of the pressure", required_id},
                                {"SF", &T::sf, "-", "scale of the curve", or_blank(1)},
                                {"AT", &T::at, "T", "start time"},
                                {"N1", &T::n1, "-", "corner node", id_of(IdSpace::node)},
                                {"N2", &T::n2, "-", "corner node", id_of(IdSpace::node)},
                                {"N3", &T::n3, "-", "corner node", id_of(IdSpace::node)},
                                {"N4", &T::n4, "-", "corner node", id_of(IdSpace::node)},
                                {"N5", &T::n5, "-", "mid-side node", id_of(IdSpace::node)}}},
                    {.fields = {{"N6", &T::n6, "-", "mid-side node", id_of(IdSpace::node)},
                                {"N7", &T::n7, "-", "mid-side node", id_of(IdSpace::node)},
                                {"N8", &T::n8, "-", "mid-side node", id_of(IdSpace::node)}},
                     .when = [](const T& e) { return e.n5 != 0; }}}};
}
const RegisterKeyword<LoadSegment> load_segment_keyword{load_segment()};

struct LoadSegmentSet : Entry {
  std::string title;
  Id entry_id = 0;
  Id ssid = 0, lcid = 0;
  Real sf = 0, at = 0;
};
KeywordOf<LoadSegmentSet> load_segment_set() {
  using T = LoadSegmentSet;
  return {.names = {"LOAD_SEGMENT_SET"},
          .purpose = "pressure on segment sets",
          .id_space = IdSpace::definition,
          .id_option = true,
          .title = &T::title,
          .id = &T::entry_id,
          .lacking = "pressures on segments",
          .cards = {{.fields = {{"SSID", &T::ssid, "-", "segment set", required_id},
                                {"LCID", &T::lcid, "-", "curve of the pressure", id_of(IdSpace::curve)},
                                {"SF", &T::sf, "-", "scale of the curve", or_blank(1)},
                                {"AT", &T::at, "T", "start time"}}}}};
}
const RegisterKeyword<LoadSegmentSet> load_segment_set_keyword{load_segment_set()};

struct RigidwallPlanar : Entry {
  std::string title;
  Id entry_id = 0;
  Id nsid = 0, nsidex = 0, boxid = 0, node1 = 0, node2 = 0, ssid = 0, node1f = 0, node2f = 0, node3f = 0,
     node4f = 0, pid = 0;
  int soft = 0;
  Real offset = 0, birth = 0, death = 0, rwksf = 0, xt = 0, yt = 0, zt = 0, xh = 0, yh = 0, zh = 0, fric = 0,
       wvel = 0, sfrica = 0, sfricb = 0, dfrica = 0, dfricb = 0, decaya = 0, decayb = 0, d1 = 0, d2 = 0,
       d3 = 0, xhev = 0, yhev = 0, zhev = 0, lenl = 0, lenm = 0, mass = 0, v0 = 0, ro = 0, e = 0, pr = 0;
};
KeywordOf<RigidwallPlanar> rigidwall_planar() {
  using T = RigidwallPlanar;
  return {
      .names = {"RIGIDWALL_PLANAR",
                "RIGIDWALL_PLANAR_ORTHO",
                "RIGIDWALL_PLANAR_FINITE",
                "RIGIDWALL_PLANAR_ORTHO_FINITE",
                "RIGIDWALL_PLANAR_MOVING",
                "RIGIDWALL_PLANAR_ORTHO_MOVING",
                "RIGIDWALL_PLANAR_FINITE_MOVING",
                "RIGIDWALL_PLANAR_ORTHO_FINITE_MOVING",
                "RIGIDWALL_PLANAR_FORCES",
                "RIGIDWALL_PLANAR_ORTHO_FORCES",
                "RIGIDWALL_PLANAR_FINITE_FORCES",
                "RIGIDWALL_PLANAR_ORTHO_FINITE_FORCES",
                "RIGIDWALL_PLANAR_MOVING_FORCES",
                "RIGIDWALL_PLANAR_ORTHO_MOVING_FORCES",
                "RIGIDWALL_PLANAR_FINITE_MOVING_FORCES",
                "RIGIDWALL_PLANAR_ORTHO_FINITE_MOVING_FORCES",
                "RIGIDWALL_PLANAR_DISPLAY",
                "RIGIDWALL_PLANAR_ORTHO_DISPLAY",
                "RIGIDWALL_PLANAR_FINITE_DISPLAY",
                "RIGIDWALL_PLANAR_ORTHO_FINITE_DISPLAY",
                "RIGIDWALL_PLANAR_MOVING_DISPLAY",
                "RIGIDWALL_PLANAR_ORTHO_MOVING_DISPLAY",
                "RIGIDWALL_PLANAR_FINITE_MOVING_DISPLAY",
                "RIGIDWALL_PLANAR_ORTHO_FINITE_MOVING_DISPLAY",
                "RIGIDWALL_PLANAR_FORCES_DISPLAY",
                "RIGIDWALL_PLANAR_ORTHO_FORCES_DISPLAY",
                "RIGIDWALL_PLANAR_FINITE_FORCES_DISPLAY",
                "RIGIDWALL_PLANAR_ORTHO_FINITE_FORCES_DISPLAY",
                "RIGIDWALL_PLANAR_MOVING_FORCES_DISPLAY",
                "RIGIDWALL_PLANAR_ORTHO_MOVING_FORCES_DISPLAY",
                "RIGIDWALL_PLANAR_FINITE_MOVING_FORCES_DISPLAY",
                "RIGIDWALL_PLANAR_ORTHO_FINITE_MOVING_FORCES_DISPLAY"},
      .purpose = "plane that nodes do not pass; options add cards in the order of the names",
      .id_space = IdSpace::rigid_wall,
      .id_option = true,
      .title = &T::title,
      .id = &T::entry_id,
      .lacking = "rigid walls",
      .cards = {{.fields = {{"NSID", &T::nsid, "-", "tracked nodes, 0 all"},
                            {"NSIDEX", &T::nsidex, "-", "exempt nodes", id_of(IdSpace::node_set)},
                            {"BOXID", &T::boxid, "-", "box id (*DEFINE_BOX)", id_of(IdSpace::box)},
                            {"OFFSET", &T::offset, "L", "only nodes within this distance"},
                            {"BIRTH", &T::birth, "T", "start time"},
                            {"DEATH", &T::death, "T", "end time", or_blank(1e20)},
                            {"RWKSF", &T::rwksf, "-", "stiffness scale (implicit)", or_blank(1)}}},
                {.fields = {{"XT", &T::xt, "L", "tail of the vector (normal)", point},
                            {"YT", &T::yt, "L", "tail of the vector (normal)"},
                            {"ZT", &T::zt, "L", "tail of the vector (normal)"},
                            {"XH", &T::xh, "L", "head of the vector (normal)", point},
                            {"YH", &T::yh, "L", "head of the vector (normal)"},
                            {"ZH", &T::zh, "L", "head of the vector (normal)"},
                            {"FRIC", &T::fric, "-", "0 slip; 1 stick; 0-1 Coulomb; 2,3 weld"},
                            {"WVEL", &T::wvel, "L/T", "normal speed for welding"}}},
                {.fields = {{"SFRICA", &T::sfrica, "-", "static friction in direction a"},
                            {"SFRICB", &T::sfricb, "-", "static friction in direction b"},
                            {"DFRICA", &T::dfrica, "-", "dynamic friction in direction a"},
                            {"DFRICB", &T::dfricb, "-", "dynamic friction in direction b"},
                            {"DECAYA", &T::decaya, "T/L", "decay in direction a"},
                            {"DECAYB", &T::decayb, "T/L", "decay in direction b"}},
                 .when = [](const T& e) { return (e.name & 1) != 0; }},
                {.fields = {{"NODE1", &T::node1, "-", "node that gives direction d", id_of(IdSpace::node)},
                            {"NODE2", &T::node2, "-", "node that gives direction d", id_of(IdSpace::node)},
                            {"D1", &T::d1, "-", "direction d, x", direction},
                            {"D2", &T::d2, "-", "direction d, y"},
                            {"D3", &T::d3, "-", "direction d, z"}},
                 .when = [](const T& e) { return (e.name & 1) != 0; }},
                {.fields = {{"XHEV", &T::xhev, "L", "head of the edge vector, x", point},
                            {"YHEV", &T::yhev, "L", "head of the edge vector, y"},
                            {"ZHEV", &T::zhev, "L", "head of the edge vector, z"},
                            {"LENL", &T::lenl, "L", "length of edge l, 0 infinite"},
                            {"LENM", &T::lenm, "L", "length of edge m, 0 infinite"}},
                 .when = [](const T& e) { return (e.name & 2) != 0; }},
                {.fields = {{"MASS", &T::mass, "M", "mass of the wall"},
                            {"V0", &T::v0, "L/T", "its speed at the start"}},
                 .when = [](const T& e) { return (e.name & 4) != 0; }},
                {.fields = {{"SOFT", &T::soft, "-", "cycles that stop a node"},
                            {"SSID", &T::ssid, "-", "segments of the display", id_of(IdSpace::segment_set)},
                            {"NODE1F", &T::node1f, "-", "node of the display", id_of(IdSpace::node)},
                            {"NODE2F", &T::node2f, "-", "node of the display", id_of(IdSpace::node)},
                            {"NODE3F", &T::node3f, "-", "node of the display", id_of(IdSpace::node)},
                            {"NODE4F", &T::node4f, "-", "node of the display", id_of(IdSpace::node)}},
                 .when = [](const T& e) { return (e.name & 8) != 0; }},
                {.fields = {{"PID", &T::pid, "-", "part of the display", id_of(IdSpace::part)},
                            {"RO", &T::ro, "M/L3", "its density", or_blank(1e-9)},
                            {"E", &T::e, "M/LT2", "its modulus", or_blank(1e-4)},
                            {"PR", &T::pr, "-", "its Poisson ratio", or_blank(0.3)}},
                 .optional = true,
                 .when = [](const T& e) { return (e.name & 16) != 0; }}}};
}
const RegisterKeyword<RigidwallPlanar> rigidwall_planar_keyword{rigidwall_planar()};

struct RigidwallGeometricFlat : Entry {
  std::string title;
  Id entry_id = 0;
  Id nsid = 0, nsidex = 0, boxid = 0, lcid = 0, pid = 0;
  int opt = 0;
  Real birth = 0, death = 0, xt = 0, yt = 0, zt = 0, xh = 0, yh = 0, zh = 0, fric = 0, xhev = 0, yhev = 0,
       zhev = 0, lenl = 0, lenm = 0, lenp = 0, radsph = 0, vx = 0, vy = 0, vz = 0, ro = 0, e = 0, pr = 0;
};
KeywordOf<RigidwallGeometricFlat> rigidwall_geometric_flat() {
  using T = RigidwallGeometricFlat;
  // cylinders may have any number of sections, so they have no table
  return {.names = {"RIGIDWALL_GEOMETRIC_FLAT", "RIGIDWALL_GEOMETRIC_PRISM", "RIGIDWALL_GEOMETRIC_SPHERE",
                    "RIGIDWALL_GEOMETRIC_FLAT_MOTION", "RIGIDWALL_GEOMETRIC_PRISM_MOTION",
                    "RIGIDWALL_GEOMETRIC_SPHERE_MOTION", "RIGIDWALL_GEOMETRIC_FLAT_DISPLAY",
                    "RIGIDWALL_GEOMETRIC_PRISM_DISPLAY", "RIGIDWALL_GEOMETRIC_SPHERE_DISPLAY",
                    "RIGIDWALL_GEOMETRIC_FLAT_MOTION_DISPLAY", "RIGIDWALL_GEOMETRIC_PRISM_MOTION_DISPLAY",
                    "RIGIDWALL_GEOMETRIC_SPHERE_MOTION_DISPLAY"},
          .purpose = "rigid obstacle: plate, prism or sphere",
          .id_space = IdSpace::rigid_wall,
          .id_option = true,
          .title = &T::title,
          .id = &T::entry_id,
          .lacking = "rigid walls",
          .cards = {{.fields = {{"NSID", &T::nsid, "-", "tracked nodes, 0 all"},
                                {"NSIDEX", &T::nsidex, "-", "exempt nodes", id_of(IdSpace::node_set)},
                                {"BOXID", &T::boxid, "-", "box id (*DEFINE_BOX)", id_of(IdSpace::box)},
                                {"BIRTH", &T::birth, "T", "start time"},
                                {"DEATH", &T::death, "T", "end time", or_blank(1e20)}}},
                    {.fields = {{"XT", &T::xt, "L", "tail of the vector (normal)", point},
                                {"YT", &T::yt, "L", "tail of the vector (normal)"},
                                {"ZT", &T::zt, "L", "tail of the vector (normal)"},
                                {"XH", &T::xh, "L", "head of the vector (normal)", point},
                                {"YH", &T::yh, "L", "head of the vector (normal)"},
                                {"ZH", &T::zh, "L", "head of the vector (normal)"},
                                {"FRIC", &T::fric, "-", "0 slip; 1 stick; else Coulomb"}}},
                    {.fields = {{"XHEV", &T::xhev, "L", "head of the edge vector, x", point},
                                {"YHEV", &T::yhev, "L", "head of the edge vector, y"},
                                {"ZHEV", &T::zhev, "L", "head of the edge vector, z"},
                                {"LENL", &T::lenl, "L", "length of edge l, 0 infinite"},
                                {"LENM", &T::lenm, "L", "length of edge m, 0 infinite"},
                                {"LENP", &T::lenp, "L", "length of edge p of a prism, 0 infinite"}},
                     .when = [](const T& e) { return e.name % 3 < 2; }},
                    {.fields = {{"RADSPH", &T::radsph, "L", "radius of the sphere"}},
                     .when = [](const T& e) { return e.name % 3 == 2; }},
                    {.fields = {{"LCID", &T::lcid, "-", "motion curve", id_of(IdSpace::curve)},
                                {"OPT", &T::opt, "-", "0 velocity; 1 displacement"},
                                {"VX", &T::vx, "-", "motion direction cosine", direction},
                                {"VY", &T::vy, "-", "motion direction cosine"},
                                {"VZ", &T::vz, "-", "motion direction cosine"}},
                     .when = [](const T& e) { return e.name / 3 % 2 == 1; }},
                    {.fields = {{"PID", &T::pid, "-", "part of the display", id_of(IdSpace::part)},
                                {"RO", &T::ro, "M/L3", "its density", or_blank(1e-9)},
                                {"E", &T::e, "M/LT2", "its modulus", or_blank(1e-4)},
                                {"PR", &T::pr, "-", "its Poisson ratio", or_blank(0.3)}},
                     .optional = true,
                     .when = [](const T& e) { return e.name >= 6; }}}};
}
const RegisterKeyword<RigidwallGeometricFlat> rigidwall_geometric_flat_keyword{rigidwall_geometric_flat()};

}  // namespace

}  // namespace courant
