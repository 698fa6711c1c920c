// Keywords of particles whose physics is not here: their cards are read and checked, and the deck is refused
// by name.
#include <string>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

using namespace rules;

namespace {

struct SectionSphEllipse : Entry {
  std::string title;
  Id secid = 0;
  int sphkern = 0;
  Real cslh = 0, hmin = 0, hmax = 0, sphini = 0, death = 0, start = 0, hxcslh = 0, hycslh = 0, hzcslh = 0,
       hxini = 0, hyini = 0, hzini = 0;
};
KeywordOf<SectionSphEllipse> section_sph_ellipse() {
  using T = SectionSphEllipse;
  return {.names = {"SECTION_SPH_ELLIPSE", "SECTION_SPH_TENSOR"},
          .purpose = "smoothing lengths that differ by axis",
          .id_space = IdSpace::section,
          .title_option = true,
          .title = &T::title,
          .lacking = "smoothing lengths that differ by axis",
          .cards = {{.fields = {{"SECID", &T::secid, "-", "section id", required_id},
                                {"CSLH", &T::cslh, "-",
                                 "initial h = CSLH x max of nearest-neighbour distances", or_blank(1.2)},
                                {"HMIN", &T::hmin, "-", "lower bound factor on h/h0", or_blank(0.2)},
                                {"HMAX", &T::hmax, "-", "upper bound factor on h/h0", or_blank(2)},
                                {"SPHINI", &T::sphini, "L", "given h0; CSLH then unused"},
                                {"DEATH", &T::death, "T", "time SPH approximation stops", or_blank(1e20)},
                                {"START", &T::start, "T", "time SPH approximation starts"},
                                {"SPHKERN", &T::sphkern, "-", "0 cubic; 1 quintic; 2 quadratic; 3 quartic"}}},
                    {.fields = {{"HXCSLH", &T::hxcslh, "-", "smoothing-length constant per axis"},
                                {"HYCSLH", &T::hycslh, "-", "smoothing-length constant per axis"},
                                {"HZCSLH", &T::hzcslh, "-", "smoothing-length constant per axis"},
                                {"HXINI", &T::hxini, "L", "given initial smoothing length per axis"},
                                {"HYINI", &T::hyini, "L", "given initial smoothing length per axis"},
                                {"HZINI", &T::hzini, "L", "given initial smoothing length per axis"}}}}};
}
const RegisterKeyword<SectionSphEllipse> section_sph_ellipse_keyword{section_sph_ellipse()};

struct SectionSphUser : Entry {
  std::string title;
  Id secid = 0;
  int sphkern = 0;
  Real cslh = 0, hmin = 0, hmax = 0, sphini = 0, death = 0, start = 0;
};
KeywordOf<SectionSphUser> section_sph_user() {
  using T = SectionSphUser;
  return {
      .names = {"SECTION_SPH_USER"},
      .purpose = "smoothing length from a user subroutine",
      .id_space = IdSpace::section,
      .title_option = true,
      .title = &T::title,
      .lacking = "user subroutines",
      .cards = {{.fields = {{"SECID", &T::secid, "-", "section id", required_id},
                            {"CSLH", &T::cslh, "-", "initial h = CSLH x max of nearest-neighbour distances",
                             or_blank(1.2)},
                            {"HMIN", &T::hmin, "-", "lower bound factor on h/h0", or_blank(0.2)},
                            {"HMAX", &T::hmax, "-", "upper bound factor on h/h0", or_blank(2)},
                            {"SPHINI", &T::sphini, "L", "given h0; CSLH then unused"},
                            {"DEATH", &T::death, "T", "time SPH approximation stops", or_blank(1e20)},
                            {"START", &T::start, "T", "time SPH approximation starts"},
                            {"SPHKERN", &T::sphkern, "-", "0 cubic; 1 quintic; 2 quadratic; 3 quartic"}}}}};
}
const RegisterKeyword<SectionSphUser> section_sph_user_keyword{section_sph_user()};

struct ControlSphIncompressible : Entry {
  int ibndp = 0, ihtc = 0, imat = 0, irmv = 0;
  Real tavg = 0, tmax = 0, rol = 0, acmp = 0;
};
KeywordOf<ControlSphIncompressible> control_sph_incompressible() {
  using T = ControlSphIncompressible;
  return {
      .names = {"CONTROL_SPH_INCOMPRESSIBLE"},
      .purpose = "implicit incompressible particles",
      .once = true,
      .many = false,
      .lacking = "incompressible particles",
      .cards = {
          {.fields = {{"IBNDP", &T::ibndp, "-", "wall pressure: 0 extrapolated; 1 computed"},
                      {"TAVG", &T::tavg, "-", "convergence: mean relative density excess", or_blank(0.01)},
                      {"TMAX", &T::tmax, "-", "convergence: maximum relative density excess", or_blank(1e20)},
                      {"ROL", &T::rol, "-", "stuck-particle detection threshold", or_blank(1e20)},
                      {"IHTC", &T::ihtc, "-", "heat-transfer coefficient: 0 no 1 yes <0 function"},
                      {"IMAT", &T::imat, "-", "0 numerical 1 physical surface tension"},
                      {"IRMV", &T::irmv, "-", "1 remove initially overlapping fluid particles"},
                      {"ACMP", &T::acmp, "-", "artificial compressibility (unit dependent)"}}}}};
}
const RegisterKeyword<ControlSphIncompressible> control_sph_incompressible_keyword{
    control_sph_incompressible()};

struct BoundarySphFlow : Entry {
  Id id = 0, lcid = 0, nid = 0, vid = 0;
  int styp = 0, dof = 0, vad = 0;
  Real sf = 0, death = 0, birth = 0;
};
KeywordOf<BoundarySphFlow> boundary_sph_flow() {
  using T = BoundarySphFlow;
  return {
      .names = {"BOUNDARY_SPH_FLOW"},
      .purpose = "particles that flow in through a plane",
      .lacking = "flow boundaries of particles",
      .cards = {
          {.fields = {{"ID",
                       &T::id,
                       "-",
                       "node set, part or part set",
                       {},
                       [](const T& e) {
                         return e.styp == 2   ? IdSpace::part
                                : e.styp == 3 ? IdSpace::node_set
                                              : IdSpace::part_set;
                       }},
                      {"STYP", &T::styp, "-", "1 part set 2 part 3 node set", or_blank(1)},
                      {"DOF", &T::dof, "-", "1 x 2 y 3 z 4 along VID"},
                      {"VAD", &T::vad, "-", "before activation: 0 velocity 1 acceleration 2 displacement"},
                      {"LCID", &T::lcid, "-", "curve (or function) id", id_of(IdSpace::curve)},
                      {"SF", &T::sf, "-", "curve scale factor", or_blank(1)},
                      {"DEATH", &T::death, "T", "end time", or_blank(1e20)},
                      {"BIRTH", &T::birth, "T", "start time"}}},
          {.fields = {{"NID", &T::nid, "-", "node on the activation plane", id_of(IdSpace::node)},
                      {"VID", &T::vid, "-", "vector normal to that plane", id_of(IdSpace::vector)}}}}};
}
const RegisterKeyword<BoundarySphFlow> boundary_sph_flow_keyword{boundary_sph_flow()};

struct BoundarySphNonReflecting : Entry {
  Real vtx = 0, vty = 0, vtz = 0, vhx = 0, vhy = 0, vhz = 0;
};
KeywordOf<BoundarySphNonReflecting> boundary_sph_non_reflecting() {
  using T = BoundarySphNonReflecting;
  return {.names = {"BOUNDARY_SPH_NON_REFLECTING"},
          .purpose = "plane that lets waves out",
          .lacking = "non-reflecting boundaries",
          .cards = {{.fields = {{"VTX", &T::vtx, "L", "tail point on the plane", point},
                                {"VTY", &T::vty, "L", "tail point on the plane"},
                                {"VTZ", &T::vtz, "L", "tail point on the plane"},
                                {"VHX", &T::vhx, "L", "head point", point},
                                {"VHY", &T::vhy, "L", "head point"},
                                {"VHZ", &T::vhz, "L", "head point"}}}}};
}
const RegisterKeyword<BoundarySphNonReflecting> boundary_sph_non_reflecting_keyword{
    boundary_sph_non_reflecting()};

struct BoundarySphNoslip : Entry {
  Id id = 0, cid = 0, vid = 0, lcid = 0;
  int idtyp = 0;
};
KeywordOf<BoundarySphNoslip> boundary_sph_noslip() {
  using T = BoundarySphNoslip;
  return {.names = {"BOUNDARY_SPH_NOSLIP"},
          .purpose = "particles that make a wall without slip",
          .lacking = "boundary particles",
          .cards = {
              {.fields = {{"ID",
                           &T::id,
                           "-",
                           "dummy particle id",
                           {},
                           [](const T& e) {
                             return e.idtyp == 0   ? IdSpace::node_set
                                    : e.idtyp == 1 ? IdSpace::node
                                    : e.idtyp == 2 ? IdSpace::part_set
                                                   : IdSpace::part;
                           }},
                          {"IDTYP", &T::idtyp, "-", "0 node set 1 node 2 part set 3 part"},
                          {"CID", &T::cid, "-", "system of the velocity", id_of(IdSpace::coordinate_system)},
                          {"VID", &T::vid, "-", "fictitious wall velocity vector", id_of(IdSpace::vector)},
                          {"LCID", &T::lcid, "-", "velocity scale curve", id_of(IdSpace::curve)}}}}};
}
const RegisterKeyword<BoundarySphNoslip> boundary_sph_noslip_keyword{boundary_sph_noslip()};

}  // namespace

}  // namespace courant
