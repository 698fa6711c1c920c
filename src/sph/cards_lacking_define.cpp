// *DEFINE_SPH_ keywords whose physics is not here: their cards are read and checked, and the deck is refused
// by name.
#include <string>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

using namespace rules;

namespace {

struct DefineSphActiveRegion : Entry {
  std::string title;
  Id id = 0, nid = 0, icid = 0;
  int type = 0, stype = 0, cycle = 0, ibuff = 0;
  Real ximin = 0, yimin = 0, zimin = 0, ximax = 0, yimax = 0, zimax = 0, xomin = 0, yomin = 0, zomin = 0,
       xomax = 0, yomax = 0, zomax = 0, x0 = 0, y0 = 0, z0 = 0, xh = 0, yh = 0, zh = 0, rmin = 0, zmin = 0,
       rmax = 0, zmax = 0;
};
KeywordOf<DefineSphActiveRegion> define_sph_active_region() {
  using T = DefineSphActiveRegion;
  return {
      .names = {"DEFINE_SPH_ACTIVE_REGION"},
      .purpose = "region outside of which particles rest",
      .title_option = true,
      .title = &T::title,
      .lacking = "regions of active particles besides BOXID of *CONTROL_SPH",
      .cards = {{.fields = {{"ID",
                             &T::id,
                             "-",
                             "part set or part",
                             {},
                             [](const T& e) { return e.type == 1 ? IdSpace::part : IdSpace::part_set; }},
                            {"TYPE", &T::type, "-", "0 part set; 1 part"},
                            {"STYPE", &T::stype, "-", "0 box 1 cylinder 2 sphere"},
                            {"CYCLE", &T::cycle, "-", "cycles between checks", or_blank(1)},
                            {"NID", &T::nid, "-", "region moves with this node", id_of(IdSpace::node)},
                            {"ICID", &T::icid, "-", "local system", id_of(IdSpace::coordinate_system)},
                            {"IBUFF", &T::ibuff, "-", "1 freeze particles at outer box rim"}}},
                {.fields = {{"XIMIN", &T::ximin, "L", "inner box minimum", point},
                            {"YIMIN", &T::yimin, "L", "inner box minimum"},
                            {"ZIMIN", &T::zimin, "L", "inner box minimum"},
                            {"XIMAX", &T::ximax, "L", "inner box maximum", point},
                            {"YIMAX", &T::yimax, "L", "inner box maximum"},
                            {"ZIMAX", &T::zimax, "L", "inner box maximum"}},
                 .when = [](const T& e) { return e.stype == 0; }},
                {.fields = {{"XOMIN", &T::xomin, "L", "outer box minimum", point},
                            {"YOMIN", &T::yomin, "L", "outer box minimum"},
                            {"ZOMIN", &T::zomin, "L", "outer box minimum"},
                            {"XOMAX", &T::xomax, "L", "outer box maximum", point},
                            {"YOMAX", &T::yomax, "L", "outer box maximum"},
                            {"ZOMAX", &T::zomax, "L", "outer box maximum"}},
                 .when = [](const T& e) { return e.stype == 0; }},
                {.fields = {{"X0", &T::x0, "L", "cylinder base or sphere centre", point},
                            {"Y0", &T::y0, "L", "cylinder base or sphere centre"},
                            {"Z0", &T::z0, "L", "cylinder base or sphere centre"},
                            {"XH", &T::xh, "L", "cylinder axis head", point},
                            {"YH", &T::yh, "L", "cylinder axis head"},
                            {"ZH", &T::zh, "L", "cylinder axis head"}},
                 .when = [](const T& e) { return e.stype == 1; }},
                {.fields = {{"RMIN", &T::rmin, "L", "inner radius"},
                            {"ZMIN", &T::zmin, "L", "inner cylinder length"},
                            {"RMAX", &T::rmax, "L", "outer radius"},
                            {"ZMAX", &T::zmax, "L", "outer cylinder length"}},
                 .when = [](const T& e) { return e.stype == 1; }},
                {.fields = {{"X0", &T::x0, "L", "cylinder base or sphere centre", point},
                            {"Y0", &T::y0, "L", "cylinder base or sphere centre"},
                            {"Z0", &T::z0, "L", "cylinder base or sphere centre"}},
                 .when = [](const T& e) { return e.stype == 2; }},
                {.fields = {{"RMIN", &T::rmin, "L", "inner radius"}, {"RMAX", &T::rmax, "L", "outer radius"}},
                 .when = [](const T& e) { return e.stype == 2; }}}};
}
const RegisterKeyword<DefineSphActiveRegion> define_sph_active_region_keyword{define_sph_active_region()};

struct DefineSphToSphCoupling : Entry {
  std::string title;
  Id entry_id = 0;
  Id sida = 0, sidb = 0, iboxa = 0, iboxb = 0;
  int satyp = 0, sbtyp = 0, isoft = 0;
  Real pfact = 0, srad = 0, dfact = 0;
};
KeywordOf<DefineSphToSphCoupling> define_sph_to_sph_coupling() {
  using T = DefineSphToSphCoupling;
  return {.names = {"DEFINE_SPH_TO_SPH_COUPLING"},
          .purpose = "penalty between particles of two parts",
          .id_space = IdSpace::definition,
          .id_option = true,
          .title = &T::title,
          .id = &T::entry_id,
          .lacking = "couplings between particles",
          .cards = {{.fields = {{"SIDA", &T::sida, "-", "part or part set"},
                                {"SIDB",
                                 &T::sidb,
                                 "-",
                                 "part or part set",
                                 {},
                                 [](const T& e) { return e.sbtyp == 1 ? IdSpace::part : IdSpace::part_set; }},
                                {"SATYP", &T::satyp, "-", "0 part set; 1 part"},
                                {"SBTYP", &T::sbtyp, "-", "0 part set; 1 part"},
                                {"IBOXA", &T::iboxa, "-", "restricting box", id_of(IdSpace::box)},
                                {"IBOXB", &T::iboxb, "-", "restricting box", id_of(IdSpace::box)},
                                {"PFACT", &T::pfact, "-", "penalty scale", or_blank(1)},
                                {"SRAD", &T::srad, "-", "scale on contact radius (sum of h)", or_blank(1)}}},
                    {.fields = {{"DFACT", &T::dfact, "-", "contact damping scale"},
                                {"ISOFT", &T::isoft, "-", "0 penalty; 1 soft (mass/dt2 based)"}},
                     .optional = true}}};
}
const RegisterKeyword<DefineSphToSphCoupling> define_sph_to_sph_coupling_keyword{
    define_sph_to_sph_coupling()};

struct DefineSphDeCoupling : Entry {
  std::string title;
  Id entry_id = 0;
  Id sphid = 0, desid = 0, sphbox = 0;
  int sphtyp = 0, destyp = 0;
  Real pfact = 0, dfact = 0;
};
KeywordOf<DefineSphDeCoupling> define_sph_de_coupling() {
  using T = DefineSphDeCoupling;
  return {
      .names = {"DEFINE_SPH_DE_COUPLING"},
      .purpose = "penalty between particles and discrete elements",
      .id_space = IdSpace::definition,
      .id_option = true,
      .title = &T::title,
      .id = &T::entry_id,
      .lacking = "discrete elements",
      .cards = {{.fields = {{"SPHID", &T::sphid, "-", "SPH part or set"},
                            {"DESID",
                             &T::desid,
                             "-",
                             "discrete-element part or set",
                             {},
                             [](const T& e) { return e.destyp == 1 ? IdSpace::part : IdSpace::part_set; }},
                            {"SPHTYP", &T::sphtyp, "-", "0 part set; 1 part"},
                            {"DESTYP", &T::destyp, "-", "0 part set; 1 part"},
                            {"PFACT", &T::pfact, "-", "penalty scale", or_blank(1)},
                            {"DFACT", &T::dfact, "-", "damping scale"},
                            {"SPHBOX", &T::sphbox, "-", "box for the SPH side", id_of(IdSpace::box)}}}}};
}
const RegisterKeyword<DefineSphDeCoupling> define_sph_de_coupling_keyword{define_sph_de_coupling()};

struct DefineAdaptiveSolidToSph : Entry {
  std::string title;
  Id entry_id = 0;
  Id ipid = 0, ipsph = 0, issph = 0;
  int itype = 0, nq = 0, icpl = 0, iopt = 0;
  Real cpcd = 0;
};
KeywordOf<DefineAdaptiveSolidToSph> define_adaptive_solid_to_sph() {
  using T = DefineAdaptiveSolidToSph;
  return {
      .names = {"DEFINE_ADAPTIVE_SOLID_TO_SPH"},
      .purpose = "solid elements that turn into particles",
      .id_space = IdSpace::definition,
      .id_option = true,
      .title = &T::title,
      .id = &T::entry_id,
      .lacking = "solid elements",
      .cards = {{.fields = {{"IPID", &T::ipid, "-", "solid part or part set"},
                            {"ITYPE", &T::itype, "-", "0 part; else set"},
                            {"NQ", &T::nq, "-", "1, 8 (=2) or 27 (=3) particles per solid", or_blank(1)},
                            {"IPSPH", &T::ipsph, "-", "part for the particles", id_of(IdSpace::part)},
                            {"ISSPH", &T::issph, "-", "section for the particles", id_of(IdSpace::section)},
                            {"ICPL", &T::icpl, "-", "0 debris; 1 coupled; 3 thermal coupling"},
                            {"IOPT", &T::iopt, "-", "0 coupled from start; 1 after failure"},
                            {"CPCD", &T::cpcd, "-", "thermal coupling conductivity"}}}}};
}
const RegisterKeyword<DefineAdaptiveSolidToSph> define_adaptive_solid_to_sph_keyword{
    define_adaptive_solid_to_sph()};

struct DefineSphAmbientDrag : Entry {
  std::string filename;
  int icpl = 0;
  Real vx = 0, vy = 0, vz = 0, rhoa = 0, mua = 0, sftens = 0;
};
KeywordOf<DefineSphAmbientDrag> define_sph_ambient_drag() {
  using T = DefineSphAmbientDrag;
  return {.names = {"DEFINE_SPH_AMBIENT_DRAG"},
          .purpose = "drag of still or moving air on particles",
          .lacking = "forces of air on particles",
          .cards = {{.fields = {{"ICPL", &T::icpl, "-", "1 air velocity from a CFD profile file"},
                                {"VX", &T::vx, "L/T", "ambient velocity", direction},
                                {"VY", &T::vy, "L/T", "ambient velocity"},
                                {"VZ", &T::vz, "L/T", "ambient velocity"},
                                {"RHOA", &T::rhoa, "M/L3", "ambient density"},
                                {"MUA", &T::mua, "M/LT", "ambient viscosity"},
                                {"SFTENS", &T::sftens, "M/T2", "surface tension"}}},
                    {.fields = {{"FILENAME", &T::filename, "-", "profile file name", {.width = 60}}},
                     .optional = true,
                     .when = [](const T& e) { return e.icpl == 1; }}}};
}
const RegisterKeyword<DefineSphAmbientDrag> define_sph_ambient_drag_keyword{define_sph_ambient_drag()};

struct DefineSphMeshBox : Entry {
  Id ipid = 0, idseg = 0;
  int nx = 0, ny = 0, nz = 0;
  Real xmin = 0, ymin = 0, zmin = 0, xlen = 0, ylen = 0, zlen = 0, sfsp = 0;
};
KeywordOf<DefineSphMeshBox> define_sph_mesh_box() {
  using T = DefineSphMeshBox;
  return {.names = {"DEFINE_SPH_MESH_BOX"},
          .purpose = "particles on a lattice in a box",
          .lacking = "particles made by keyword",
          .cards = {{.fields = {{"XMIN", &T::xmin, "L", "box corner", point},
                                {"YMIN", &T::ymin, "L", "box corner"},
                                {"ZMIN", &T::zmin, "L", "box corner"},
                                {"XLEN", &T::xlen, "L", "box size"},
                                {"YLEN", &T::ylen, "L", "box size"},
                                {"ZLEN", &T::zlen, "L", "box size"}}},
                    {.fields = {{"IPID", &T::ipid, "-", "part of the particles", id_of(IdSpace::part)},
                                {"NX", &T::nx, "-", "particle count"},
                                {"NY", &T::ny, "-", "particle count"},
                                {"NZ", &T::nz, "-", "particle count"},
                                {},
                                {"IDSEG", &T::idseg, "-", "segment set that trims the box (sign = side)",
                                 id_of(IdSpace::segment_set)},
                                {"SFSP", &T::sfsp, "-", "spacing scale for removal near segments"}}}}};
}
const RegisterKeyword<DefineSphMeshBox> define_sph_mesh_box_keyword{define_sph_mesh_box()};

struct DefineSphMeshSurface : Entry {
  Id sid = 0, sphpid = 0, sphxid = 0, nsid = 0;
  int type = 0, iout = 0;
  Real space = 0;
};
KeywordOf<DefineSphMeshSurface> define_sph_mesh_surface() {
  using T = DefineSphMeshSurface;
  return {
      .names = {"DEFINE_SPH_MESH_SURFACE"},
      .purpose = "particles on the surface of parts",
      .lacking = "particles made by keyword",
      .cards = {{.fields = {{"SID",
                             &T::sid,
                             "-",
                             "part or part set to cover",
                             {},
                             [](const T& e) { return e.type == 1 ? IdSpace::part : IdSpace::part_set; }},
                            {"TYPE", &T::type, "-", "0 part set; 1 part"},
                            {"SPHPID", &T::sphpid, "-", "part of the particles", id_of(IdSpace::part)},
                            {"SPHXID", &T::sphxid, "-", "section of the particles", id_of(IdSpace::section)},
                            {"NSID", &T::nsid, "-", "node set to create", id_of(IdSpace::node_set)},
                            {"SPACE", &T::space, "L", "maximum spacing"},
                            {"IOUT", &T::iout, "-", "1 write result as keyword file"}}}}};
}
const RegisterKeyword<DefineSphMeshSurface> define_sph_mesh_surface_keyword{define_sph_mesh_surface()};

struct DefineBoxSph : Entry {
  std::string title;
  Id boxid = 0, vid = 0, lcid = 0, nid = 0, pid = 0;
  int vd = 0, ireact = 0, ibuff = 0, ishow = 0;
  Real xmn = 0, xmx = 0, ymn = 0, ymx = 0, zmn = 0, zmx = 0;
};
KeywordOf<DefineBoxSph> define_box_sph() {
  using T = DefineBoxSph;
  return {
      .names = {"DEFINE_BOX_SPH"},
      .purpose = "box of active particles that moves",
      .id_space = IdSpace::box,
      .title_option = true,
      .title = &T::title,
      .lacking = "moving boxes of active particles",
      .cards = {{.fields = {{"BOXID", &T::boxid, "-", "box id", required_id},
                            {"XMN", &T::xmn, "L", "lower bound"},
                            {"XMX", &T::xmx, "L", "upper bound"},
                            {"YMN", &T::ymn, "L", "lower bound"},
                            {"YMX", &T::ymx, "L", "upper bound"},
                            {"ZMN", &T::zmn, "L", "lower bound"},
                            {"ZMX", &T::zmx, "L", "upper bound"},
                            {"VID", &T::vid, "-", "direction vector of the motion", id_of(IdSpace::vector)}}},
                {.fields = {{"LCID", &T::lcid, "-", "motion curve", id_of(IdSpace::curve)},
                            {"VD", &T::vd, "-", "0 velocity; 1 displacement; 2 follows NID"},
                            {"NID", &T::nid, "-", "node the box follows", id_of(IdSpace::node)},
                            {"IREACT", &T::ireact, "-", "1 particles re-entering are reactivated"},
                            {"IBUFF", &T::ibuff, "-", "1 particles in rim frozen as neighbours"},
                            {"ISHOW", &T::ishow, "-", "1 make a dummy part for display"},
                            {"PID", &T::pid, "-", "id of that part", id_of(IdSpace::part)}}}}};
}
const RegisterKeyword<DefineBoxSph> define_box_sph_keyword{define_box_sph()};

}  // namespace

}  // namespace courant
