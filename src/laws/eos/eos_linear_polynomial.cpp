#include "laws/eos/eos.hpp"
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
};

struct EosLinearPolynomial : Entry {
  Id eosid = 0;
  Real c0 = 0, c1 = 0, c2 = 0, c3 = 0, c4 = 0, c5 = 0, c6 = 0, E0 = 0, V0 = 1;
  std::string title;
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
    {.names = {"EOS_LINEAR_POLYNOMIAL", "EOS_001"},
     .purpose = "pressure as a polynomial of compression, with energy",
     .id_space = IdSpace::eos,
     .title_option = true,
     .title = &EosLinearPolynomial::title,
     .cards = {
         {.fields = {eosid_field<EosLinearPolynomial>(),
                     {"C0", &EosLinearPolynomial::c0, "M/LT2", "pressure at mu = 0", {}},
                     {"C1", &EosLinearPolynomial::c1, "M/LT2", "bulk modulus, rho0 c0^2", {}},
                     {"C2", &EosLinearPolynomial::c2, "M/LT2", "factor of mu^2, in compression", {}},
                     {"C3", &EosLinearPolynomial::c3, "M/LT2", "factor of mu^3", {}},
                     {"C4", &EosLinearPolynomial::c4, "-", "factor of E", {}},
                     {"C5", &EosLinearPolynomial::c5, "-", "factor of mu E", {}},
                     {"C6", &EosLinearPolynomial::c6, "-", "factor of mu^2 E, in compression", {}}}},
         {.fields =
              {{"E0", &EosLinearPolynomial::E0, "M/LT2", "initial internal energy per reference volume", {}},
               v0_field<EosLinearPolynomial>()},
          .optional = true}}}};

}  // namespace

}  // namespace courant
