#include <cmath>

#include "laws/eos/eos.hpp"
#include "laws/eos/eos_cards.hpp"
#include "laws/eos/eos_fields.hpp"

namespace courant {

namespace {

/// p = A3/V^A1 exp(-A2 V) (1 - B1/V) + B2 E/V, V = rho0/rho = 1/(1 + mu)
struct SackTuesday {
  static constexpr const char* name = "sack tuesday";
  Real a1, a2, a3;  // [-], [-], [M/LT2]
  Real b1, b2;      // [-]
  Real A(Real mu) const { return factor(1 + mu) * (1 - b1 * (1 + mu)); }
  Real dA(Real mu) const {
    const Real x = 1 + mu;  // 1/V
    return factor(x) * ((a1 + a2 / x) / x * (1 - b1 * x) - b1);
  }
  Real B(Real mu) const { return b2 * (1 + mu); }
  Real dB(Real) const { return b2; }
  bool uses_energy() const { return b2 != 0; }
  const char* stiffness_field() const { return ""; }

 private:
  Real factor(Real x) const { return a3 * std::pow(x, a1) * std::exp(-a2 / x); }
};

struct EosSackTuesday : EosSackTuesdayFields {
  SackTuesday law() const { return {a1, a2, a3, b1, b2}; }
  Real e0() const { return E0; }
  Real v0() const { return V0; }
};

using Sack = EosSackTuesday;

// By hand, with A3 that takes the exponential away. V = 1, A1 = 2, A2 = 1, A3 = 100 e, B1 = 1/4, B2 = 1/2,
// E = 10: 100 (1 - 1/4) + 5 = 80. V = 2, A3 = 40 e^2, E = 8: 10 (1 - 1/8) + 2 = 10.75. V = 1/2, A3 =
// e^(1/2), E = 3: 4 (1 - 1/2) + 3 = 5.
const RegisterEos<EosSackTuesday> eos_sack_tuesday{
    "p = A3/V^A1 exp(-A2 V) (1 - B1/V) + B2 E/V, V = rho0/rho",
    "Sack's law of the products of a detonation (Woodruff 1973, UCRL-51462: KOVEC)",
    {{"1,2.0,1.0,271.8281828459045,0.25,0.5\n", 0, 10, 80},
     {"1,2.0,1.0,295.5622439572260,0.25,0.5\n", -0.5, 8, 10.75},
     {"1,2.0,1.0,1.648721270700128,0.25,0.5\n", 1, 3, 5}},
    eos_sack_tuesday_table()};

}  // namespace

}  // namespace courant
