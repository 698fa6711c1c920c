// Tables of artificial viscosity and hourglass control.
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/conditions/viscosity_cards.hpp"

namespace courant {

namespace {

using namespace rules;

constexpr FieldRules coefficient(Real standard) {
  return {.standard = standard, .check = Check::not_negative};
}

const RegisterKeyword<Hourglass> hourglass{
    {.names = {"HOURGLASS"},
     .purpose = "bulk viscosity of the parts that name it (HGID), and hourglass control of their elements",
     .id_space = IdSpace::hourglass,
     .title_option = true,
     .title = &Hourglass::title,
     .cards = {
         {.fields = {
              {"HGID", &Hourglass::hgid, "-", "id that *PART refers to", required_id},
              {"IHQ", &Hourglass::ihq, "-",
               "1 to 3 viscous, 4 and 5 a stiffness, 6 assumed strains in solids, 0 that of "
               "*CONTROL_HOURGLASS"},
              {"QM", &Hourglass::qm, "-", "its coefficient; 0: 0.1, with IHQ 0 that of *CONTROL_HOURGLASS"},
              {"IBQ", &Hourglass::ibq, "-", "not used", no_effect},
              {"Q1", &Hourglass::q1, "-",
               "quadratic viscosity (beta); 0 is the default, write 1.0E-20 for none", coefficient(1.5)},
              {"Q2", &Hourglass::q2, "-",
               "linear viscosity (alpha); 0 is the default, write 1.0E-20 for none", coefficient(0.06)},
              {"QB/VDC", &Hourglass::qb, "-", "coefficient for bending of shells; 0: QM"},
              {"QW", &Hourglass::qw, "-", "coefficient for warping of shells; 0: QM"}}}}}};

using H = ControlHourglass;
const RegisterKeyword<H> control_hourglass{
    {.names = {"CONTROL_HOURGLASS"},
     .purpose = "hourglass control of elements without an *HOURGLASS; particles and rigid shells have none",
     .once = true,
     .many = false,
     .cards = {{.fields = {{"IHQ", &H::ihq, "-",
                            "1 to 3 viscous, 0 as 1; 4 and 5 a stiffness; 6 assumed strains in solids"},
                           {"QH", &H::qh, "-", "coefficient; 0 is the default, write 1.0E-20 for none",
                            or_blank(0.1)}}}}}};

using B = ControlBulkViscosity;
const RegisterKeyword<B> bulk_viscosity{
    {.names = {"CONTROL_BULK_VISCOSITY"},
     .purpose = "artificial viscosity coefficients of parts without an *HOURGLASS",
     .once = true,
     .many = false,
     .cards = {
         {.fields = {
              {"Q1", &B::q1, "-", "quadratic viscosity (beta); 0 is the default, write 1.0E-20 for none",
               coefficient(1.5)},
              {"Q2", &B::q2, "-", "linear viscosity (alpha); 0 is the default, write 1.0E-20 for none",
               coefficient(0.06)},
              {"TYPE",
               &B::type,
               "-",
               "1 in solids and particles; -1, -2: also in shells that deform",
               {.standard = 1, .allowed = {-2, -1, 1}}},
              {"BTYPE", &B::btype, "-", "beams", no_effect},
              {"TSTYPE", &B::tstype, "-", "thick shells", no_effect}}}}}};

}  // namespace

}  // namespace courant
