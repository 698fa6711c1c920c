#include "shell/section_shell.hpp"

#include "keyword/registry.hpp"

namespace courant {
namespace {

using S = SectionShell;
constexpr Honour no = Honour::no, ignored = Honour::ignored;

const RegisterKeyword<S> section_shell{
    {.names = {"SECTION_SHELL"},
     .purpose = "thickness of shells; formulation and points of those that deform",
     .id_space = IdSpace::section,
     .title_option = true,
     .title = &S::title,
     .cards = {
         {.fields =
              {{"SECID",
                &S::secid,
                "-",
                "id that *PART refers to",
                {.required = true, .check = Check::positive}},
               {"ELFORM",
                &S::elform,
                "-",
                "formulation of shells that deform: 2 Belytschko-Tsay, 4 flat triangle, 16 2 x 2 points",
                {.standard = 2}},
               {"SHRF", &S::shrf, "-", "factor of transverse shear", {.standard = 1}},
               {"NIP", &S::nip, "-", "points through the thickness", {.standard = 2}},
               {"PROPT", &S::propt, "-", "print option", {.standard = 1, .honour = ignored}},
               {"QR/IRID", &S::irid, "-", "quadrature rule: 0"},
               {"ICOMP", &S::icomp, "-", "1 layered composite, which is not supported"},
               {"SETYP", &S::setyp, "-", "type of 2D solids", {.standard = 1, .honour = ignored}}}},
         {.fields =
              {{"T1", &S::t1, "L", "thickness at corner 1", {.check = Check::not_negative}},
               {"T2", &S::t2, "L", "thickness at corner 2, 0: T1", {.check = Check::not_negative}},
               {"T3", &S::t3, "L", "thickness at corner 3, 0: T1", {.check = Check::not_negative}},
               {"T4", &S::t4, "L", "thickness at corner 4, 0: T1", {.check = Check::not_negative}},
               {"NLOC", &S::nloc, "-", "reference surface off the middle", {.honour = no}},
               {"MAREA", &S::marea, "M/L2", "mass per area besides RO t", {.check = Check::not_negative}},
               {"IDOF", &S::idof, "-", "thickness strain: not 3"},
               {"EDGSET", &S::edgset, "-", "edge set of seat belts", {.honour = no}}}},
         // how many lines these have, their own numbers tell; such sections are refused
         {.fields = {{"USER", &S::user, "-", "user-defined formulation (ELFORM 101 to 105), angles (ICOMP)"}},
          .repeat = true,
          .when = [](const S& s) { return s.user_defined() || s.icomp != 0; }}}}};

}  // namespace
}  // namespace courant
