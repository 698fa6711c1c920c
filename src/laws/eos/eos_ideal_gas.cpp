#include "laws/eos/eos.hpp"
#include "laws/eos/eos_cards.hpp"
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
  const char* stiffness_field() const { return ""; }
};

struct EosIdealGas : EosIdealGasFields {
  IdealGas law() const { return {cp / cv - 1}; }
  Real e0() const { return 0; }
  Real specific_e0() const { return cv * T0; }
  Real v0() const { return V0; }
};

// By hand: air, CP/CV = 1005/718 - 1 = 287/718; E = 718 . 1.2 . 300, mu = 0: p = 1.2 . 287 . 300 = 103320.
const RegisterEos<EosIdealGas> eos_ideal_gas{
    "p = rho (CPMAS - CVMAS) T, T = E/(RO CVMAS)",
    "thermal equation of state of a perfect gas with constant heat capacities",
    {{"1,718.0,1005.0,,,300.0,1.0\n", 0, 718 * 1.2 * 300, 103320},
     {"1,2.0,3.0,,,1.0,1.0\n", 0.5, 4, 3},
     {"1,2.0,3.0,,,1.0,1.0\n", -0.5, 4, 1}},
    eos_ideal_gas_table()};

}  // namespace

}  // namespace courant
