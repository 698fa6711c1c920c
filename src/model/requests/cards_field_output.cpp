// Tables of what the field files hold.
#include "keyword/registry.hpp"
#include "model/requests/output_cards.hpp"
#include "model/requests/request_cards.hpp"

namespace courant {

namespace {

KeywordOf<DatabaseExtentBinary> database_extent_binary() {
  using T = DatabaseExtentBinary;
  return {
      .names = {"DATABASE_EXTENT_BINARY"},
      .purpose = "extra fields in d3plot: integration points, and more of particles",
      .once = true,
      .many = false,
      .cards = {
          {.fields = {{"NEIPH", &T::neiph, "-",
                       "extra variables of SPH: stress, strain_rate, sound_speed, density_rate; solids have "
                       "theirs always",
                       FieldRules{.check = Check::not_negative}},
                      {"NEIPS", &T::neips, "-", "history variables of shells, at the points of MAXINT",
                       FieldRules{.check = Check::not_negative}},
                      {"MAXINT", &T::maxint, "-",
                       "points of shells: 3 lower, middle, upper; else the first MAXINT",
                       FieldRules{.standard = 3}},
                      {"STRFLG", &T::strflg, "-",
                       "not 0: strains of solids and shells, in the field files, d3plot and elout",
                       FieldRules{.check = Check::not_negative}},
                      {"SIGFLG", &T::sigflg, "-", "1 stress / plastic strain in", no_effect_but(1)},
                      {"EPSFLG", &T::epsflg, "-", "1 stress / plastic strain in", no_effect_but(1)},
                      {"RLTFLG", &T::rltflg, "-", "1 resultants / energy, thickness in", no_effect_but(1)},
                      {"ENGFLG", &T::engflg, "-", "1 resultants / energy, thickness in", no_effect_but(1)}}},
          {.fields = {{"CMPFLG", &T::cmpflg, "-", "material axes flag", no_effect},
                      {"IEVERP", &T::ieverp, "-", "1 one state per file", no_effect},
                      {"BEAMIP", &T::beamip, "-", "points of beams written",
                       FieldRules{.check = Check::not_negative}},
                      {"DCOMP", &T::dcomp, "-", "rigid-data compression 1-6", no_effect_but(1)},
                      {"SHGE", &T::shge, "-", "shell hourglass energy 2 on", no_effect_but(1)},
                      {"STSSZ", &T::stssz, "-", "time step / mass output", no_effect_but(1)},
                      {"N3THDT", &T::n3thdt, "-", "material energies in d3thdt", no_effect_but(2)},
                      {"IALEMAT", &T::ialemat, "-", "ALE part list", no_effect_but(1)}},
           .optional = true},
          {.fields = {{"NINTSLD", &T::nintsld, "-", "points of solids written, also in elout",
                       FieldRules{.standard = 1, .allowed = {1, 8}}},
                      {"PKP_SEN", &T::pkp_sen, "-", "peak pressure and energy in intfor", no_effect},
                      {"SCLP", &T::sclp, "-", "scale on that", no_effect_but(1)},
                      {"HYDRO", &T::hydro, "-", "1 adds 3, 2 adds 5 shock variables", no_effect},
                      {"MSSCL", &T::msscl, "-", "added-mass output", no_effect},
                      {"THERM", &T::therm, "-", "thermal output", no_effect},
                      {"INTOUT", &T::intout, "-", "detailed element output words", no_effect},
                      {"NODOUT", &T::nodout, "-", "detailed element output words", no_effect}},
           .optional = true},
          {.fields = {{"DTDT", &T::dtdt, "-", "temperature rate", no_effect},
                      {"RESPLT", &T::resplt, "-", "1 writes the array force", FieldRules{.allowed = {0, 1}}},
                      {"NEIPB", &T::neipb, "-", "beam history variables", no_effect},
                      {"QUADSLD", &T::quadsld, "-", "higher-order solids output", no_effect},
                      {"CUBSLD", &T::cubsld, "-", "higher-order solids output", no_effect},
                      {"DELERES", &T::deleres, "-", "results of deleted elements", no_effect}},
           .optional = true}}};
}
const RegisterKeyword<DatabaseExtentBinary> database_extent_binary_keyword{database_extent_binary()};

const RegisterKeyword<CourantOutputCard> courant_output{courant_output_table()};

}  // namespace

}  // namespace courant
