#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "laws/eos/eos.hpp"
#include "laws/eos/eos_cards.hpp"
#include "laws/eos/eos_fields.hpp"

namespace courant {

namespace {

/// Where D(mu) = 1 - (S1 - 1) mu - S2 mu^2/(1 + mu) - S3 mu^3/(1 + mu)^2 first becomes 0 for mu > 0; infinite
/// if it does not. D (1 + mu)^2 is a cubic: it is looked at between its turning points.
Real pole_of(Real s1, Real s2, Real s3) {
  const auto cubic = [=](Real mu) {
    return ((1 - (s1 - 1) * mu) * (1 + mu) - s2 * mu * mu) * (1 + mu) - s3 * mu * mu * mu;
  };
  // cubic = 1 + k1 mu + k2 mu^2 + k3 mu^3
  const Real k1 = 3 - s1, k2 = 3 - 2 * s1 - s2, k3 = 1 - s1 - s2 - s3;
  constexpr Real far = 1e6;
  std::array<Real, 4> ends{0, far, far, far};
  const Real root = k2 * k2 - 3 * k1 * k3;
  if (root >= 0) {  // turning points, in a form that also holds for k3 = 0
    const Real q = -(k2 + std::copysign(std::sqrt(root), k2));
    if (k3 != 0) ends[1] = std::clamp(q / (3 * k3), Real(0), far);
    if (q != 0) ends[2] = std::clamp(k1 / q, Real(0), far);
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 1; k < ends.size(); ++k) {
    if (cubic(ends[k]) > 0) continue;
    Real a = ends[k - 1], b = ends[k];
    while (true) {
      const Real middle = 0.5 * (a + b);
      if (middle == a || middle == b) return b;
      (cubic(middle) > 0 ? a : b) = middle;
    }
  }
  return std::numeric_limits<Real>::infinity();
}

/// mu > 0: p = rho0 C^2 mu (1 + (1 - GAMMA0/2) mu - A/2 mu^2) / D^2 + (GAMMA0 + A mu) E with
/// D = 1 - (S1 - 1) mu - S2 mu^2/(1 + mu) - S3 mu^3/(1 + mu)^2; mu < 0: p = rho0 C^2 mu + (GAMMA0 + A mu) E.
struct Gruneisen {
  static constexpr const char* name = "gruneisen";
  Real K;                           // rho0 C^2 [M/LT2]
  Real s1, s2, s3, gamma0, a, end;  // [-]
  Real A(Real mu) const {
    if (mu <= 0) return K * mu;
    const Real d = D(mu);
    return K * mu * (1 + mu * ((1 - gamma0 / 2) - a / 2 * mu)) / (d * d);
  }
  Real dA(Real mu) const {
    if (mu <= 0) return K;
    const Real d = D(mu), n = mu * (1 + mu * ((1 - gamma0 / 2) - a / 2 * mu));
    const Real dn = 1 + mu * (2 * (1 - gamma0 / 2) - 1.5 * a * mu);
    const Real r = mu / (1 + mu);
    const Real dd = 1 - s1 - s2 * r * (1 + 1 / (1 + mu)) - s3 * r * r * (1 + 2 / (1 + mu));
    return K * (dn - 2 * n * dd / d) / (d * d);
  }
  Real B(Real mu) const { return gamma0 + a * mu; }
  Real dB(Real) const { return a; }
  bool uses_energy() const { return gamma0 != 0 || a != 0; }
  Real mu_limit() const { return end; }
  const char* stiffness_field() const { return s1 > 0 ? "" : "C"; }
  Gruneisen at_density(Real rho0) const { return {K * rho0, s1, s2, s3, gamma0, a, end}; }

 private:
  Real D(Real mu) const {
    const Real r = mu / (1 + mu);
    return 1 - mu * ((s1 - 1) + r * (s2 + s3 * r));
  }
};

struct EosGruneisen : EosGruneisenFields {
  Gruneisen law() const { return {C * C, s1, s2, s3, gamma0, a, pole_of(s1, s2, s3)}; }
  Real e0() const { return E0; }
  Real v0() const { return V0; }
};

// By hand. Water-like, C = 2, S1 = 2, rho0 = 3, mu = 0.25: rho0 C^2 = 12, D = 1 - 0.25 = 3/4,
// numerator 12 . 1/4 (1 + 1/4) = 15/4, p = 15/4 . 16/9 = 20/3. All terms, mu = 1: GAMMA0 = 1, A = 1/2, S1
// = 1.25, S2 = 1/4, S3 = 1/2: D = 1 - 1/4 - 1/8 - 1/8 = 1/2, numerator 1 + 1/2 - 1/4 = 5/4, p = C^2
// (5/4)/(1/4)
// + (3/2) E = 4 . 5 + 3 = 23. Tension, mu = -1/2: p = -2 + (1 - 1/4) 2 = -1/2.
const RegisterEos<EosGruneisen> eos_gruneisen{
    "mu > 0: p = RO C^2 mu [1 + (1 - GAMMA0/2) mu - A/2 mu^2] / [1 - (S1 - 1) mu - S2 mu^2/(mu + 1) - S3 "
    "mu^3/(mu + "
    "1)^2]^2 + (GAMMA0 + A mu) E; mu < 0: p = RO C^2 mu + (GAMMA0 + A mu) E",
    "Mie-Grueneisen with the Hugoniot us = C + S1 up + S2 (up/us) up + S3 (up/us)^2 up: Steinberg 1996",
    {{"1,2.0,2.0\n1.0\n", 0.25, 0, 20.0 / 3, 3},
     {"1,2.0,1.25,0.25,0.5,1.0,0.5\n1.0\n", 1, 2, 23},
     {"1,2.0,1.25,0.25,0.5,1.0,0.5\n1.0\n", -0.5, 2, -0.5}},
    eos_gruneisen_table()};

}  // namespace

}  // namespace courant
