#include "elements/beam/mat_cable.hpp"

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

using C = MatCableDiscreteBeam;
constexpr FieldRules time_field{.check = Check::not_negative};

const RegisterKeyword<C> mat_cable{
    {.names = {"MAT_CABLE_DISCRETE_BEAM", "MAT_071"},
     .purpose = "cables that pull and do not push: beams with ELFORM 6",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &C::title,
     .cards =
         {{.fields = {{"MID", &C::mid, "-", "id that *PART refers to", rules::required_id},
                      {"RO", &C::ro, "M/L3", "density, of VOL of *SECTION_BEAM", rules::required_positive},
                      {"E", &C::e, "M/LT2", "Young's modulus; < 0: minus force over elongation [M/T2]"},
                      {"LCID", &C::lcid, "-", "curve of the stress over the strain in place of E",
                       rules::optional_id_of(IdSpace::curve)},
                      {"F0", &C::f0, "ML/T2", "tension at the start", {.check = Check::not_negative}},
                      {"TMAXF0", &C::tmaxf0, "T", "until when the tension is held", time_field},
                      {"TRAMP", &C::tramp, "T", "in which it rises from 0 to F0", time_field},
                      {"IREAD", &C::iread, "-", "1: there is a second card", {.allowed = {0, 1}}}}},
          {.fields = {{"OUTPUT", &C::output, "-", "1: axial strain in files", no_output},
                      {"TSTART", &C::tstart, "T", "when it begins to rise", time_field},
                      {"FRACL0", &C::fracl0, "-", "share of its length that it is drawn in to", unsupported},
                      {"MXEPS",
                       &C::mxeps,
                       "-",
                       "strain at which it breaks",
                       {.standard = 1e20, .check = Check::positive}},
                      {"MXFRC",
                       &C::mxfrc,
                       "ML/T2",
                       "force at which it breaks",
                       {.standard = 1e20, .check = Check::positive}}},
           .when = [](const C& c) { return c.iread == 1; }}},
     .convert = [](C& card, const Conversion& conversion) {
       // the table has turned it as a modulus
       if (card.e < 0) card.e *= conversion.units.of("M/T2") / conversion.units.of("M/LT2");
       return std::string();
     }}};

}  // namespace

}  // namespace courant
