#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyword/expectations.hpp"
#include "laws/materials/strength_cards.hpp"
#include "laws/strength/isotropic_plasticity.hpp"
#include "laws/strength/rate_factor.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// sigma_y = K (e0 + e)^N, with the influence of the rate by Cowper and Symonds.
struct PowerLaw {
  Real K = 0, N = 0;  ///< [M/LT2], [-]
  Real e0 = 0;        ///< strain at which yielding begins [-]
  CowperSymonds rate_term{};
  YieldRate rate() const { return rate_term.counts() ? YieldRate::of_flow : YieldRate::none; }
  bool steep() const { return true; }
  bool smooth() const { return true; }
  bool has_increments() const { return false; }
  Real increment(Real, Real, Real) const { return 0; }
  void at(YieldPoints& points) const {
    loops.power_law(K, e0, N, points);
    if (rate_term.counts()) loops.scale(rate_term, points);
  }
  RateLoops loops = rate_loops();
};

using Power = struct MatPowerLawPlasticity;
struct MatPowerLawPlasticity : MatPowerLawPlasticityFields {
  static constexpr Real largest_strain = 0.02;
  bool sigy_is_stress = false;  ///< told before it was converted
  /// SIGY is a stress, or up to 0.02 the strain e0 itself; 0: where the power law meets E e.
  Real first_strain() const {
    if (sigy > largest_strain || sigy_is_stress) return std::pow(sigy / k, 1 / n);
    return sigy > 0 ? sigy : std::pow(E / k, 1 / (n - 1));
  }
  std::shared_ptr<StrengthLaw> law() const {
    PowerLaw yield{.K = k, .N = n, .e0 = first_strain()};
    yield.rate_term.C = src, yield.rate_term.P = src > 0 ? srp : 1;
    auto law = std::make_shared<IsotropicPlasticity<PowerLaw>>(ro, E, pr, yield);
    if (epsf > 0 && epsf < never_fails) law->fails_at = epsf;
    return law;
  }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    const auto expect = expectations_of(*this, deck, diagnostics);
    expect(pr < 0.5, "PR", "a number < 0.5", pr,
           "a material that keeps its volume has no finite bulk modulus");
    expect(n > 0 && n < 1, "N", "a number between 0 and 1", n, "the exponent of hardening");
    if (src > 0)
      expect(vp == 0 || vp == 1, "VP", "0 or 1", vp, "1: the rate is that of plastic strain");
    else if (vp != 0 && vp != 1)
      deck.warning(diagnostics, *this, "VP", "has no effect without SRC",
                   "a strain at which points fail belongs into EPSF, the field behind");
    expect((src > 0) == (srp > 0), src > 0 ? "SRP" : "SRC", "a number > 0", 0,
           "the rate of strain counts by SRC and SRP together; leave both blank where it does not");
  }
};

// By hand. E = 2.5, PR = 1/4: G = 1, 3 G = 3, dt = 1/2. Pulled by (2, -1, -1): s = (4, -2, -2), q = 6. K = 3,
// N = 1/2: with a = e0 + e before, 2 - de = sqrt(a + de), de = (5 - sqrt(9 + 4 a))/2. SIGY = 3/2: e0 = 1/4;
// SIGY = 0: e0 = (2.5/3)^-2 = 1.44; SIGY = 0.01: that. The rate of flow is 2 de; SRC = 1, SRP 2 or 1 double
// the yield stress at de = 1/2: SIGY = 3/4, a = 1/16: 6 - 3 de = 6 sqrt(a + de).
StrengthReference flows_by(const std::string& cards, Real before, Real de) {
  const Real q = 6 - 3 * de;
  return {cards, {2, -1, -1}, {}, {2 * q / 3, -q / 3, -q / 3}, {before}, {before + de}};
}
const RegisterStrength<Power> mat_power_law_plasticity{
    "q = sqrt(3/2 s:s) <= K (e0 + e)^N (1 + (rate/SRC)^(1/SRP)), e0 by SIGY or E e0 = K e0^N; return along "
    "s; "
    "pressure by Hooke's law",
    "J2 plasticity with radial return: Krieg & Key 1976; rates: Cowper & Symonds 1957",
    {flows_by("1,2.0,2.5,0.25,3.0,0.5\n1.5\n", 0.140625, 0.875),
     flows_by("1,2.0,2.5,0.25,3.0,0.5\n", 0, 0.5 * (5 - std::sqrt(14.76))),
     flows_by("1,2.0,2.5,0.25,3.0,0.5\n0.01\n", 0, 0.5 * (5 - std::sqrt(9.04))),
     flows_by("1,2.0,2.5,0.25,3.0,0.5,1.0,2.0\n0.75\n", 0, 0.5),
     flows_by("1,2.0,2.5,0.25,3.0,0.5,1.0,1.0\n0.75,1.0\n", 0, 0.5)},
    mat_power_law_plasticity_table()};

}  // namespace

/// Where SIGY is a strain it has no unit.
std::string keep_first_strain(MatPowerLawPlasticityFields& fields, const Conversion& conversion) {
  auto& card = static_cast<MatPowerLawPlasticity&>(fields);
  const Real factor = conversion.units.of("M/LT2");
  card.sigy_is_stress = card.sigy > Power::largest_strain * factor;
  if (!card.sigy_is_stress) card.sigy /= factor;
  return "";
}

}  // namespace courant
