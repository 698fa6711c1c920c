// Control keywords without influence on results.
#include <string>

#include "keyword/registry.hpp"

namespace courant {

namespace {

struct ControlOutput : Entry {
  int npopt = 0, neecho = 0, nrefup = 0, iaccop = 0, ipnint = 0, ikedit = 0, iflush = 0, iprtf = 0,
      ierode = 0, tet10s8 = 0, msgmax = 0, ipcurv = 0, ip1dblt = 0, eocs = 0, tolev = 0, newleg = 0,
      frfreq = 0, minfo = 0, solsig = 0, msgflg = 0, igeom = 0, phschng = 0, demden = 0, icrfile = 0,
      spc2bnd = 0, penout = 0, shlsig = 0, hisnout = 0, engout = 0, insf = 0, isolsf = 0, ibsf = 0, issf = 0,
      mlkbag = 0, kineng = 0, isfcnt = 0, ielogkey = 0, ielogini = 0, ielogsol = 0;
  Real opifs = 0, gmdt = 0, cdetol = 0;
};
KeywordOf<ControlOutput> control_output() {
  using T = ControlOutput;
  return {
      .names = {"CONTROL_OUTPUT"},
      .purpose = "printed output: none of it exists here",
      .once = true,
      .many = false,
      .cards = {
          {.fields =
               {{"NPOPT", &T::npopt, "-", "1 suppress nodes, elements in d3hsp", no_effect},
                {"NEECHO", &T::neecho, "-", "echo-file suppression 0-3", no_effect},
                {"NREFUP", &T::nrefup, "-", "beam reference node update", no_effect},
                {"IACCOP", &T::iaccop, "-", "nodout accelerations 0 raw 1 averaged 2 filtered", no_effect},
                {"OPIFS", &T::opifs, "-", "interface-file interval", no_effect},
                {"IPNINT", &T::ipnint, "-", "time steps listed on cycle 1 (0 -> 100 smallest)", no_effect},
                {"IKEDIT", &T::ikedit, "-", "cycles between status reports in d3hsp", no_effect_but(100)},
                {"IFLUSH", &T::iflush, "-", "cycles between buffer flushes", no_effect_but(5000)}}},
          {.fields = {{"IPRTF", &T::iprtf, "-", "which of rbdout/matsum hold part data", no_effect},
                      {"IERODE", &T::ierode, "-", "1 eroded energies in matsum", no_effect},
                      {"TET10S8", &T::tet10s8, "-", "higher-order connectivity in d3plot", no_effect_but(2)},
                      {"MSGMAX", &T::msgmax, "-", "messages of each kind printed", no_effect_but(50)},
                      {"IPCURV", &T::ipcurv, "-", "1 print digitised curves", no_effect},
                      {"GMDT", &T::gmdt, "-", "interface motion interval", no_effect},
                      {"IP1DBLT", &T::ip1dblt, "-", "belt output", no_effect},
                      {"EOCS", &T::eocs, "-", "elout coordinate system", no_effect}},
           .optional = true},
          {.fields = {{"TOLEV", &T::tolev, "-", "timing summary levels", no_effect_but(2)},
                      {"NEWLEG", &T::newleg, "-", "legend format", no_effect},
                      {"FRFREQ", &T::frfreq, "-", "failed-element report interval", no_effect_but(1)},
                      {"MINFO", &T::minfo, "-", "mortar contact information", no_effect},
                      {"SOLSIG", &T::solsig, "-", "stress extrapolation to nodes", no_effect},
                      {"MSGFLG", &T::msgflg, "-", "long messages to d3msg", no_effect},
                      {"CDETOL", &T::cdetol, "-", "curve discretisation warning tolerance, percent",
                       no_effect_but(10)},
                      {"IGEOM", &T::igeom, "-", "d3plot nodes: 1 coordinates 2 displacements",
                       no_effect_but(1)}},
           .optional = true},
          {.fields = {{"PHSCHNG", &T::phschng, "-", "phase change message", no_effect},
                      {"DEMDEN", &T::demden, "-", "DEM density output", no_effect},
                      {"ICRFILE", &T::icrfile, "-", "section set output", no_effect},
                      {"SPC2BND", &T::spc2bnd, "-", "rigid constraints as bndout motions", no_effect},
                      {"PENOUT", &T::penout, "-", "mortar penetration output", no_effect},
                      {"SHLSIG", &T::shlsig, "-", "stress extrapolation to nodes", no_effect},
                      {"HISNOUT", &T::hisnout, "-", "history variable names", no_effect},
                      {"ENGOUT", &T::engout, "-", "contact energy density output", no_effect}},
           .optional = true},
          {.fields = {{"INSF", &T::insf, "-", "write generated sets to file", no_effect},
                      {"ISOLSF", &T::isolsf, "-", "write generated sets to file", no_effect},
                      {"IBSF", &T::ibsf, "-", "write generated sets to file", no_effect},
                      {"ISSF", &T::issf, "-", "write generated sets to file", no_effect},
                      {"MLKBAG", &T::mlkbag, "-", "airbag leakage output", no_effect},
                      {"KINENG", &T::kineng, "-", "kinetic energy density field", no_effect},
                      {"ISFCNT", &T::isfcnt, "-", "interface linking continuity", no_effect_but(1)}},
           .optional = true},
          {.fields = {{"IELOGKEY", &T::ielogkey, "-", "error.log level per phase", no_effect},
                      {"IELOGINI", &T::ielogini, "-", "error.log level per phase", no_effect},
                      {"IELOGSOL", &T::ielogsol, "-", "error.log level per phase", no_effect}},
           .optional = true}}};
}
const RegisterKeyword<ControlOutput> control_output_keyword{control_output()};

struct ControlParallel : Entry {
  int ncpu = 0, numrhs = 0, const_ = 0, para = 0;
};
KeywordOf<ControlParallel> control_parallel() {
  using T = ControlParallel;
  return {.names = {"CONTROL_PARALLEL"},
          .purpose = "threads: `--threads` of the command line says how many",
          .once = true,
          .many = false,
          .cards = {{.fields = {{"NCPU", &T::ncpu, "-", "SMP threads", no_effect_but(1)},
                                {"NUMRHS", &T::numrhs, "-", "right-hand sides (0 = NCPU)", no_effect},
                                {"CONST", &T::const_, "-", "1 reproducible sums; 2 faster", no_effect_but(2)},
                                {"PARA", &T::para, "-", "parallel assembly when CONST=1", no_effect}}}}};
}
const RegisterKeyword<ControlParallel> control_parallel_keyword{control_parallel()};

struct ControlUnits : Entry {
  std::string length, time, mass, temp;
};
KeywordOf<ControlUnits> control_units() {
  using T = ControlUnits;
  return {.names = {"CONTROL_UNITS"},
          .purpose = "names of the units: any consistent ones will do",
          .once = true,
          .many = false,
          .cards = {{.fields = {{"LENGTH", &T::length, "-", "m mm cm in ft yd mil", no_effect},
                                {"TIME", &T::time, "-", "sec ms micro_s min hr", no_effect},
                                {"MASS", &T::mass, "-", "kg g oz lb ton mtrc_ton", no_effect},
                                {"TEMP", &T::temp, "-", "k c f r", no_effect}}}}};
}
const RegisterKeyword<ControlUnits> control_units_keyword{control_units()};

struct ControlRigid : Entry {
  int lmf = 0, jntf = 0, orthmd = 0, partm = 0, sparse = 0, metalf = 0, plotel = 0, rbsms = 0, norbic = 0,
      rcvlr2d = 0;
  Real gjadstf = 0, gjadvsc = 0, tjadstf = 0, tjadvsc = 0;
};
KeywordOf<ControlRigid> control_rigid() {
  using T = ControlRigid;
  return {.names = {"CONTROL_RIGID"},
          .purpose = "joints and flexible modes of rigid bodies, of which there are none",
          .once = true,
          .many = false,
          .cards = {
              {.fields = {{"LMF", &T::lmf, "-", "joints: 0 penalty 1 Lagrange multiplier", no_effect},
                          {"JNTF", &T::jntf, "-", "joint stiffness form", no_effect},
                          {"ORTHMD", &T::orthmd, "-", "orthogonalise modes", no_effect},
                          {"PARTM", &T::partm, "-", "mass distribution for modes", no_effect},
                          {"SPARSE", &T::sparse, "-", "sparse modal products", no_effect},
                          {"METALF", &T::metalf, "-", "fast rigid update (forming)", no_effect},
                          {"PLOTEL", &T::plotel, "-", "display elements for nodal rigid bodies", no_effect},
                          {"RBSMS", &T::rbsms, "-", "selective mass scaling of rigid bodies", no_effect}}},
              {.fields = {{"NORBIC", &T::norbic, "-", "1 skip inertia check", no_effect},
                          {"GJADSTF", &T::gjadstf, "-", "rotational joint stiffness, damping", no_effect},
                          {"GJADVSC", &T::gjadvsc, "-", "rotational joint stiffness, damping", no_effect},
                          {"TJADSTF", &T::tjadstf, "-", "translational joint stiffness, damping", no_effect},
                          {"TJADVSC", &T::tjadvsc, "-", "translational joint stiffness, damping", no_effect},
                          {"RCVLR2D", &T::rcvlr2d, "-", "recover lead body", no_effect}},
               .optional = true}}};
}
const RegisterKeyword<ControlRigid> control_rigid_keyword{control_rigid()};

struct ControlShell : Entry {
  int esort = 0, irnxx = 0, istupd = 0, theory = 0, bwc = 0, miter = 0, proj = 0, intgrd = 0, lamsht = 0,
      cstyp6 = 0, tshell = 0, psstupd = 0, sidt4tu = 0, cntco = 0, itsflg = 0, irquad = 0, icrq = 0,
      nfail1 = 0, nfail4 = 0, psnfail = 0, keepcs = 0, delfr = 0, drcpsid = 0, intperr = 0, drcmth = 0,
      lispsid = 0, nlocdt = 0;
  Real wrpang = 0, rotascl = 0, w_mode = 0, stretch = 0, drcprm = 0;
};
KeywordOf<ControlShell> control_shell() {
  using T = ControlShell;
  return {.names = {"CONTROL_SHELL"},
          .purpose = "formulation of shells: here all are rigid",
          .once = true,
          .many = false,
          .cards = {
              {.fields = {{"WRPANG", &T::wrpang, "-", "warning above this angle of warp", no_effect_but(20)},
                          {"ESORT", &T::esort, "-", "sorts triangles", no_effect},
                          {"IRNXX", &T::irnxx, "-", "unit normals", no_effect_but(-1)},
                          {"ISTUPD", &T::istupd, "-", "thinning", no_effect},
                          {"THEORY", &T::theory, "-", "default formulation", no_effect_but(2)},
                          {"BWC", &T::bwc, "-", "warping stiffness", no_effect_but(2)},
                          {"MITER", &T::miter, "-", "plane stress iteration", no_effect_but(1)},
                          {"PROJ", &T::proj, "-", "projection", no_effect}}},
              {.fields = {{"ROTASCL", &T::rotascl, "-", "rotational mass", no_effect_but(1)},
                          {"INTGRD", &T::intgrd, "-", "integration rule", no_effect},
                          {"LAMSHT", &T::lamsht, "-", "laminated theory", no_effect},
                          {"CSTYP6", &T::cstyp6, "-", "local system", no_effect_but(1)},
                          {"TSHELL", &T::tshell, "-", "thermal shells", no_effect}},
               .optional = true},
              {.fields = {{"PSSTUPD", &T::psstupd, "-", "parts with thinning", no_effect},
                          {"SIDT4TU", &T::sidt4tu, "-", "parts of type 4", no_effect},
                          {"CNTCO", &T::cntco, "-", "contact at offset shells", no_effect},
                          {"ITSFLG", &T::itsflg, "-", "initial transverse stress", no_effect},
                          {"IRQUAD", &T::irquad, "-", "in-plane integration", no_effect_but(3)},
                          {"W-MODE", &T::w_mode, "-", "deletion by warping", no_effect},
                          {"STRETCH", &T::stretch, "-", "deletion by stretch", no_effect},
                          {"ICRQ", &T::icrq, "-", "thickness at corners", no_effect}},
               .optional = true},
              {.fields = {{"NFAIL1", &T::nfail1, "-", "deletion of distorted elements", no_effect},
                          {"NFAIL4", &T::nfail4, "-", "deletion of distorted elements", no_effect},
                          {"PSNFAIL", &T::psnfail, "-", "parts with deletion", no_effect},
                          {"KEEPCS", &T::keepcs, "-", "keeps contact segments", no_effect},
                          {"DELFR", &T::delfr, "-", "deletes loose elements", no_effect},
                          {"DRCPSID", &T::drcpsid, "-", "drilling parts", no_effect},
                          {"DRCPRM", &T::drcprm, "-", "drilling parameter", no_effect_but(1)},
                          {"INTPERR", &T::intperr, "-", "interpolated stresses", no_effect}},
               .optional = true},
              {.fields = {{"DRCMTH", &T::drcmth, "-", "drilling method", no_effect},
                          {"LISPSID", &T::lispsid, "-", "parts of a law", no_effect},
                          {"NLOCDT", &T::nlocdt, "-", "reference surface and step", no_effect}},
               .optional = true}}};
}
const RegisterKeyword<ControlShell> control_shell_keyword{control_shell()};

struct ControlAccuracy : Entry {
  int osu = 0, inn = 0, pidosu = 0, iacc = 0;
  Real exacc = 0;
};
KeywordOf<ControlAccuracy> control_accuracy() {
  using T = ControlAccuracy;
  return {.names = {"CONTROL_ACCURACY"},
          .purpose = "objective stress and numbering: nothing here depends on them",
          .once = true,
          .many = false,
          .cards = {{.fields = {{"OSU", &T::osu, "-", "objective stress update", no_effect},
                                {"INN", &T::inn, "-", "invariant node numbering", no_effect},
                                {"PIDOSU", &T::pidosu, "-", "parts with objective stress update", no_effect},
                                {"IACC", &T::iacc, "-", "implicit accuracy", no_effect},
                                {"EXACC", &T::exacc, "-", "explicit accuracy", no_effect}}}}};
}
const RegisterKeyword<ControlAccuracy> control_accuracy_keyword{control_accuracy()};

struct ControlSolution : Entry {
  int soln = 0, nlq = 0, isnan = 0, lcint = 0, lcacc = 0;
};
KeywordOf<ControlSolution> control_solution() {
  using T = ControlSolution;
  return {
      .names = {"CONTROL_SOLUTION"},
      .purpose = "kind of analysis",
      .once = true,
      .many = false,
      .cards = {
          {.fields = {
               {"SOLN", &T::soln, "-", "0 structural", unsupported},
               {"NLQ", &T::nlq, "-", "vector length", no_effect},
               {"ISNAN", &T::isnan, "-", "check for values that are no numbers; always done", no_effect},
               {"LCINT", &T::lcint, "-", "points for resampling curves; they are not resampled", no_effect},
               {"LCACC", &T::lcacc, "-", "accuracy of curves", no_effect}}}}};
}
const RegisterKeyword<ControlSolution> control_solution_keyword{control_solution()};

}  // namespace

}  // namespace courant
