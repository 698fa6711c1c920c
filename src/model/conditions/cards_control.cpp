// Tables of control keywords and output requests.
#include "keyword/registry.hpp"
#include "model/cards.hpp"

namespace courant {

namespace {

const FieldRules optional_id{.check = Check::not_negative};
const FieldRules curve_id{.check = Check::not_negative, .refers = IdSpace::curve};
const FieldRules part_set{.check = Check::not_negative, .refers = IdSpace::part_set};
const FieldRules output_parts{.honour = Honour::output_only, .refers = IdSpace::part_set};
const FieldRules interval{.check = Check::not_negative};

using T = ControlTerminationCard;
const RegisterKeyword<T> control_termination{
    {.names = {"CONTROL_TERMINATION"},
     .purpose = "end of the run",
     .once = true,
     .many = false,
     .cards = {{.fields = {
                    {"ENDTIM", &T::endtim, "T", "end time", {.required = true, .check = Check::positive}},
                    {"ENDCYC", &T::endcyc, "-", "last step, 0 no limit", optional_id},
                    {"DTMIN", &T::dtmin, "-", "stop when the step is below DTMIN x the first step", interval},
                    {"ENDENG", &T::endeng, "-", "stop at this change of the energy ratio in per cent, 0 none",
                     interval},
                    {"ENDMAS",
                     &T::endmas,
                     "-",
                     "stop when mass scaling has added more of the mass of elements, in per cent; 0 never",
                     {.standard = 1e8, .check = Check::not_negative}},
                    {"NOSOL", &T::nosol, "-", "1 stop after the initialisation", unsupported}}}}}};

using S = ControlTimestepCard;
const RegisterKeyword<S> control_timestep{
    {.names = {"CONTROL_TIMESTEP", "CONTROL_TIME_STEP"},
     .purpose = "size of the time step",
     .once = true,
     .many = false,
     .cards = {
         {.fields =
              {{"DTINIT", &S::dtinit, "T", "first step, 0 computed", interval},
               {"TSSFAC",
                &S::tssfac,
                "-",
                "scale of the computed step",
                {.standard = 0.9, .check = Check::positive}},
               {"ISDO",
                &S::isdo,
                "-",
                "length of shells: area over longest side (0) or diagonal (1), 2 with the shortest "
                "side and the speed of a bar",
                {.allowed = {0, 1, 2}}},
               {"TSLIMT", &S::tslimt, "T", "smallest step of shells that deform", no_effect},
               {"DT2MS", &S::dt2ms, "T",
                "mass scaling: elements below the step |DT2MS| get mass; > 0: at the start all get it, or "
                "lose mass"},
               {"LCTM",
                &S::lctm,
                "-",
                "curve of the largest step over time",
                {.check = Check::not_negative, .refers = IdSpace::curve}},
               {"ERODE",
                &S::erode,
                "-",
                "elements that would bring the step below DTMIN x the first are deleted: 1 solids, 10 "
                "shells, 11 both; solids that turn inside out, too",
                {.allowed = {0, 1, 10, 11}}},
               {"MS1ST",
                &S::ms1st,
                "-",
                "mass scaling: all the time (0), at the start only (1)",
                {.allowed = {0, 1}}}}},
         {.fields = {{"DT2MSF", &S::dt2msf, "-", "step for mass scaling", unsupported},
                     {"DT2MSLC",
                      &S::dt2mslc,
                      "-",
                      "curve of the step for mass scaling",
                      {.honour = Honour::no, .refers = IdSpace::curve}},
                     {"IMSCL", &S::imscl, "-", "selective mass scaling", unsupported},
                     {},
                     {},
                     {"RMSCL", &S::rmscl, "-", "rotational mass scaling", unsupported},
                     {"EMSCL", &S::emscl, "-", "share of added mass in gravity", unsupported},
                     {"IHDO", &S::ihdo, "-", "step of solids", no_effect}},
          .optional = true},
         {.fields = {{"RMAVG", &S::rmavg, "-", "average rotational mass", unsupported},
                     {"IGADO", &S::igado, "-", "step of isogeometric elements", no_effect},
                     {"DTUSR", &S::dtusr, "T", "step of users' elements", unsupported},
                     {"DTDYNV", &S::dtdynv, "-", "viscous limit of solids", no_effect}},
          .optional = true}}}};

using D = DatabaseD3plotCard;
const RegisterKeyword<D> database_binary_d3plot{
    {.names = {"DATABASE_BINARY_D3PLOT"},
     .purpose = "interval of the field files (fields.pvd)",
     .once = true,
     .many = false,
     .cards = {
         {.fields = {{"DT", &D::dt, "T", "interval, 0 none", interval},
                     {"LCDT", &D::lcdt, "-", "curve of the interval, instead of DT", curve_id},
                     {"BEAM", &D::beam, "-", "discrete elements as beams", no_effect},
                     {"NPLTC", &D::npltc, "-", "number of states: interval = ENDTIM / NPLTC", optional_id},
                     {"PSETID", &D::psetid, "-", "parts left out", part_set}}},
         {.fields = {{"IOOPT",
                      &D::ioopt,
                      "-",
                      "1 next state at t + f(t), 2 f at the next state, 3 at the abscissae; 0 is 1",
                      {.allowed = {0, 1, 2, 3}}},
                     {"RATE", &D::rate, "T", "filter interval", no_output},
                     {"CUTOFF", &D::cutoff, "1/T", "filter frequency", no_output},
                     {"WINDOW", &D::window, "T", "filter window", no_output},
                     {"TYPE", &D::type, "-", "filtered data", no_output},
                     {"PSET", &D::pset, "-", "filtered parts", output_parts}},
          .optional = true}}}};

}  // namespace

}  // namespace courant
