#include "laws/eos/eos.hpp"
#include "laws/eos/eos_cards.hpp"
#include "laws/eos/eos_fields.hpp"

namespace courant {

namespace {

/// p = C0 + C1 mu + C2 mu^2 + C3 mu^3 + (C4 + C5 mu + C6 mu^2) E, without the C2 and C6 terms for mu < 0.
struct LinearPolynomial {
  static constexpr const char* name = "linear polynomial";
  Real c0, c1, c2, c3, c4, c5, c6;  // [M/LT2] C0-C3, [-] C4-C6
  Real A(Real mu) const { return c0 + mu * (c1 + mu * ((mu > 0 ? c2 : 0) + mu * c3)); }
  Real dA(Real mu) const { return c1 + mu * ((mu > 0 ? 2 * c2 : 0) + mu * 3 * c3); }
  Real B(Real mu) const { return c4 + mu * (c5 + (mu > 0 ? c6 * mu : 0)); }
  Real dB(Real mu) const { return c5 + (mu > 0 ? 2 * c6 * mu : 0); }
  bool uses_energy() const { return c4 != 0 || c5 != 0 || c6 != 0; }
  /// With C2 or C3 it is a fit to a shock curve.
  const char* stiffness_field() const { return c2 == 0 && c3 == 0 ? "C1" : ""; }
};

struct EosLinearPolynomial : EosLinearPolynomialFields {
  LinearPolynomial law() const { return {c0, c1, c2, c3, c4, c5, c6}; }
  Real e0() const { return E0; }
  Real v0() const { return V0; }
};

const RegisterEos<EosLinearPolynomial> eos_linear_polynomial{
    "p = C0 + C1 mu + C2 mu^2 + C3 mu^3 + (C4 + C5 mu + C6 mu^2) E",
    "Jonsson et al. 2016, eqs 13-14; water: C1 = rho0 c0^2",
    {{"         1       0.0     9.0E5       0.0       0.0       0.0       0.0       0.0\n       0.0       "
      "1.0\n",
      0.01, 0, 9000},
     {"         1       1.0      10.0     100.0    1000.0       0.0       0.0       0.0\n       0.0       "
      "1.0\n",
      0.1, 0, 4},
     {"         1       1.0      10.0     100.0    1000.0       0.0       0.0       0.0\n       0.0       "
      "1.0\n",
      -0.1, 0, -1},
     {"         1       0.0       0.0       0.0       0.0       0.4       0.4       0.0\n       2.5       "
      "1.0\n",
      0.5, 3, 1.8}},
    eos_linear_polynomial_table()};

}  // namespace

}  // namespace courant
