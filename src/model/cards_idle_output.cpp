// Output requests that nothing here serves.
#include <string>

#include "keyword/registry.hpp"

namespace courant {

namespace {

const FieldRules no_effect{.honour = Honour::ignored};
const FieldRules no_output{.honour = Honour::output_only};
FieldRules no_effect_but(Real standard) {
  return {.standard = standard, .honour = Honour::ignored};
}

struct DatabaseNodfor : Entry {
  int binary = 0, lcur = 0, ioopt = 0, option2 = 0, option3 = 0, option4 = 0;
  Real dt = 0, option1 = 0;
};
KeywordOf<DatabaseNodfor> database_nodfor() {
  using T = DatabaseNodfor;
  return {.names = {"DATABASE_NODFOR", "DATABASE_ELOUT", "DATABASE_RWFORC", "DATABASE_NCFORC",
                    "DATABASE_SECFORC", "DATABASE_JNTFORC", "DATABASE_DEFORC", "DATABASE_ABSTAT",
                    "DATABASE_SWFORC", "DATABASE_TRHIST", "DATABASE_SPHMASSFLOW", "DATABASE_DISBOUT",
                    "DATABASE_ATDOUT", "DATABASE_GCEOUT", "DATABASE_CURVOUT"},
          .purpose = "interval of a history that is not written here",
          .cards = {{.fields = {{"DT", &T::dt, "T", "interval, 0 none", no_output},
                                {"BINARY", &T::binary, "-", "kind of file", no_effect},
                                {"LCUR", &T::lcur, "-", "curve of the interval", no_effect},
                                {"IOOPT", &T::ioopt, "-", "mode of the curve", no_effect_but(1)},
                                {"OPTION1", &T::option1, "-", "option of some of them", no_effect},
                                {"OPTION2", &T::option2, "-", "option of some of them", no_effect},
                                {"OPTION3", &T::option3, "-", "option of some of them", no_effect},
                                {"OPTION4", &T::option4, "-", "option of some of them", no_effect}}}}};
}
const RegisterKeyword<DatabaseNodfor> database_nodfor_keyword{database_nodfor()};

struct DatabaseFormat : Entry {
  int iform = 0, ibinary = 0;
};
KeywordOf<DatabaseFormat> database_format() {
  using T = DatabaseFormat;
  return {.names = {"DATABASE_FORMAT"},
          .purpose = "format of the binary files: they are VTK and HDF5 here",
          .once = true,
          .many = false,
          .cards = {{.fields = {{"IFORM", &T::iform, "-", "0 LS-DYNA; 1 ANSYS; 2 both", no_effect},
                                {"IBINARY", &T::ibinary, "-", "0 64 bit; 1 32 bit", no_effect}}}}};
}
const RegisterKeyword<DatabaseFormat> database_format_keyword{database_format()};

struct DatabaseExtentBinary : Entry {
  std::string intout, nodout;
  int neiph = 0, neips = 0, maxint = 0, strflg = 0, sigflg = 0, epsflg = 0, rltflg = 0, engflg = 0,
      cmpflg = 0, ieverp = 0, beamip = 0, dcomp = 0, shge = 0, stssz = 0, n3thdt = 0, ialemat = 0,
      nintsld = 0, pkp_sen = 0, hydro = 0, msscl = 0, therm = 0, dtdt = 0, resplt = 0, neipb = 0, quadsld = 0,
      cubsld = 0, deleres = 0;
  Real sclp = 0;
};
KeywordOf<DatabaseExtentBinary> database_extent_binary() {
  using T = DatabaseExtentBinary;
  return {
      .names = {"DATABASE_EXTENT_BINARY"},
      .purpose = "extra fields in d3plot: the field files hold what the run has",
      .once = true,
      .many = false,
      .cards = {
          {.fields = {{"NEIPH", &T::neiph, "-", "extra history variables, solids and SPH", no_output},
                      {"NEIPS", &T::neips, "-", "extra history variables, shells", no_effect},
                      {"MAXINT", &T::maxint, "-", "shell integration points written", no_effect_but(3)},
                      {"STRFLG", &T::strflg, "-", "1 write strain tensor", no_output},
                      {"SIGFLG", &T::sigflg, "-", "1 stress / plastic strain in", no_effect_but(1)},
                      {"EPSFLG", &T::epsflg, "-", "1 stress / plastic strain in", no_effect_but(1)},
                      {"RLTFLG", &T::rltflg, "-", "1 resultants / energy, thickness in", no_effect_but(1)},
                      {"ENGFLG", &T::engflg, "-", "1 resultants / energy, thickness in", no_effect_but(1)}}},
          {.fields = {{"CMPFLG", &T::cmpflg, "-", "material axes flag", no_effect},
                      {"IEVERP", &T::ieverp, "-", "1 one state per file", no_effect},
                      {"BEAMIP", &T::beamip, "-", "beam integration points", no_effect},
                      {"DCOMP", &T::dcomp, "-", "rigid-data compression 1-6", no_effect_but(1)},
                      {"SHGE", &T::shge, "-", "shell hourglass energy 2 on", no_effect_but(1)},
                      {"STSSZ", &T::stssz, "-", "time step / mass output", no_effect_but(1)},
                      {"N3THDT", &T::n3thdt, "-", "material energies in d3thdt", no_effect_but(2)},
                      {"IALEMAT", &T::ialemat, "-", "ALE part list", no_effect_but(1)}},
           .optional = true},
          {.fields = {{"NINTSLD", &T::nintsld, "-", "solid points written 1 or 8", no_effect},
                      {"PKP_SEN", &T::pkp_sen, "-", "peak pressure and energy in intfor", no_effect},
                      {"SCLP", &T::sclp, "-", "scale on that", no_effect_but(1)},
                      {"HYDRO", &T::hydro, "-", "1 adds 3, 2 adds 5 shock variables", no_effect},
                      {"MSSCL", &T::msscl, "-", "added-mass output", no_effect},
                      {"THERM", &T::therm, "-", "thermal output", no_effect},
                      {"INTOUT", &T::intout, "-", "detailed element output words", no_effect},
                      {"NODOUT", &T::nodout, "-", "detailed element output words", no_effect}},
           .optional = true},
          {.fields = {{"DTDT", &T::dtdt, "-", "temperature rate", no_effect},
                      {"RESPLT", &T::resplt, "-", "residual forces", no_effect},
                      {"NEIPB", &T::neipb, "-", "beam history variables", no_effect},
                      {"QUADSLD", &T::quadsld, "-", "higher-order solids output", no_effect},
                      {"CUBSLD", &T::cubsld, "-", "higher-order solids output", no_effect},
                      {"DELERES", &T::deleres, "-", "results of deleted elements", no_effect}},
           .optional = true}}};
}
const RegisterKeyword<DatabaseExtentBinary> database_extent_binary_keyword{database_extent_binary()};

}  // namespace

}  // namespace courant
