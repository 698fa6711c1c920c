#include <cmath>

#include "laws/eos/eos.hpp"
#include "laws/eos/eos_cards.hpp"
#include "laws/eos/eos_fields.hpp"

namespace courant {

namespace {

/// p = A (1 - OMEG/(R1 V)) exp(-R1 V) + B (1 - OMEG/(R2 V)) exp(-R2 V) + OMEG E/V, V = rho0/rho = 1/(1 + mu)
struct Jwl {
  static constexpr const char* name = "jwl";
  Real a, b;           // [M/LT2]
  Real r1, r2, omega;  // [-]
  Real A(Real mu) const { return term(a, r1, 1 + mu) + term(b, r2, 1 + mu); }
  Real dA(Real mu) const { return slope(a, r1, 1 + mu) + slope(b, r2, 1 + mu); }
  Real B(Real mu) const { return omega * (1 + mu); }
  Real dB(Real) const { return omega; }
  bool uses_energy() const { return omega != 0; }
  const char* stiffness_field() const { return ""; }

 private:
  // x = 1/V
  Real term(Real factor, Real r, Real x) const { return factor * (1 - omega * x / r) * std::exp(-r / x); }
  Real slope(Real factor, Real r, Real x) const {
    return factor * ((1 - omega * x / r) * r / (x * x) - omega / r) * std::exp(-r / x);
  }
};

struct EosJwl : EosJwlFields {
  Jwl law() const { return {A, B, r1, r2, omeg}; }
  Real e0() const { return E0; }
  Real v0() const { return V0; }
};

// By hand, with A and B that take the exponentials away. V = 1, R1 = 2, R2 = 1, A = 100 e^2, B = 10 e, OMEG =
// 1/2, E = 10: 100 (1 - 1/4) + 10 (1 - 1/2) + 5 = 85. V = 2, A = 10 e^4, B = 4 e^2, OMEG = 1/2, E = 8: 10 (1
// - 1/8) + 4 (1 - 1/4) + 2 = 13.75.
const RegisterEos<EosJwl> eos_jwl{
    "p = A (1 - OMEG/(R1 V)) exp(-R1 V) + B (1 - OMEG/(R2 V)) exp(-R2 V) + OMEG E/V, V = rho0/rho",
    "Jones, Wilkins and Lee: Lee, Hornig and Kury 1968, UCRL-50422",
    {{"1,738.9056098930650,27.18281828459045,2.0,1.0,0.5\n", 0, 10, 85},
     {"1,545.9815003314424,29.55622439572260,2.0,1.0,0.5\n", -0.5, 8, 13.75}},
    eos_jwl_table()};

}  // namespace

}  // namespace courant
