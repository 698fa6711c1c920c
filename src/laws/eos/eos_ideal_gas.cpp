#include "laws/eos/eos.hpp"
#include "laws/eos/eos_fields.hpp"

namespace courant {

namespace {

/// p = rho (CP - CV) T with T = E / (rho0 CV), so p = (CP/CV - 1) (1 + mu) E.
struct IdealGas {
  static constexpr const char* name = "ideal gas";
  Real k;  // CP/CV - 1 [-]
  Real A(Real) const { return 0; }
  Real dA(Real) const { return 0; }
  Real B(Real mu) const { return k * (1 + mu); }
  Real dB(Real) const { return k; }
  bool uses_energy() const { return true; }
};

struct EosIdealGas : Entry {
  Id eosid = 0;
  Real cv = 0, cp = 0, cl = 0, cq = 0, T0 = 0, V0 = 1, vc0 = 0, adiab = 0;
  std::string title;
  IdealGas law() const { return {cp / cv - 1}; }
  Real e0() const { return 0; }
  Real specific_e0() const { return cv * T0; }
  Real v0() const { return V0; }
};

const FieldRules required{.required = true, .check = Check::positive};

// By hand: air, CP/CV = 1005/718 - 1 = 287/718; E = 718 . 1.2 . 300, mu = 0: p = 1.2 . 287 . 300 = 103320.
const RegisterEos<EosIdealGas> eos_ideal_gas{
    "p = rho (CPMAS - CVMAS) T, T = E/(RO CVMAS)",
    "thermal equation of state of a perfect gas with constant heat capacities",
    {{"1,718.0,1005.0,,,300.0,1.0\n", 0, 718 * 1.2 * 300, 103320},
     {"1,2.0,3.0,,,1.0,1.0\n", 0.5, 4, 3},
     {"1,2.0,3.0,,,1.0,1.0\n", -0.5, 4, 1}},
    {.names = {"EOS_IDEAL_GAS", "EOS_012"},
     .purpose = "perfect gas with constant heat capacities",
     .id_space = IdSpace::eos,
     .title_option = true,
     .title = &EosIdealGas::title,
     .cards = {
         {.fields =
              {eosid_field<EosIdealGas>(),
               {"CVMAS", &EosIdealGas::cv, "L2/T2", "heat capacity at constant volume, per mass", required},
               {"CPMAS", &EosIdealGas::cp, "L2/T2", "heat capacity at constant pressure, per mass", required},
               {"B", &EosIdealGas::cl, "L2/T2", "linear temperature coefficient of both", unsupported},
               {"C", &EosIdealGas::cq, "L2/T2", "quadratic temperature coefficient", unsupported},
               {"T0", &EosIdealGas::T0, "-", "initial temperature", required},
               v0_field<EosIdealGas>(),
               {"VC0", &EosIdealGas::vc0, "-", "van der Waals covolume", unsupported}}},
         {.fields = {{"ADIAB", &EosIdealGas::adiab, "-", "1 adiabatic law", unsupported}},
          .optional = true}}}};

}  // namespace

}  // namespace courant
