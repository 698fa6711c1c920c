// *MAT_CSCM and *MAT_CSCM_CONCRETE against closed forms and a brute-force return to the surface.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <fmt/format.h>

#include "driven_point.hpp"
#include "law_from_cards.hpp"
#include "model/model.hpp"

namespace cscm_test {

using namespace courant;
using test::DrivenPoint;
using test::law_from_cards;

namespace {

constexpr Real root3 = 1.7320508075688772;

/// 30 MPa, 19 mm, in MPa mm s.
std::shared_ptr<StrengthLaw> concrete(const std::string& first = "1,2.3e-9", Real fpc = 30) {
  return law_from_cards("MAT_CSCM_CONCRETE", fmt::format("{}\n0.0\n{},19.0,2\n", first, fpc));
}
/// The surface in triaxial compression by the polynomials of the report. [MPa]
struct Shear {
  Real alpha, lambda = 10.5, beta = 1.929e-2, theta;
  explicit Shear(Real f)
      : alpha(7.7047 + f * (0.3169747 - 0.003 * f)), theta(0.2140058 + f * (2.3548e-3 + 1.3216e-5 * f)) {}
  Real operator()(Real I) const { return alpha - lambda * std::exp(-beta * I) + theta * I; }
};
/// The same by *MAT_CSCM with the numbers of the report, and a cap of one's own.
std::string by_report(Real f, Real XD, const std::string& first = "1,2.3e-9") {
  const Shear F(f);
  const Real E = 18275 * std::cbrt(f / 10), of_beta = (2.2655e-4 - 1.9972e-5 * f) * f;
  const Real GFT = (0.021 + 5.357e-4 * 19) * std::pow(f / 10, 0.7), psi = 145.0377377 * f;
  const Real over = 21.45 + (1.309663e-2 * f - 0.3927659) * f;
  return fmt::format(
      "{}\n0.0\n{:.9g},{:.9g},{:.9g},{:.9g},{},{}\n0.74735,{:.9g},0.17,{:.9g},0.66,{:.9g},0.16,{:.9g}\n5.0,{:"
      ".9g},"
      "0.05,2.5e-4,3.49e-7\n100.0,{:.9g},0.1,{:.9g},{:.9g},5.0,1.0\n{:.9g},0.78,{:.9g},0.48,{:.9g},{:.9g},1."
      "0,"
      "1.0\n",
      first, E / 2.3, E / 2.1, F.alpha, F.theta, F.lambda, F.beta,
      1.5593e-3 - (1.2132e-6 + 4.0856e-7 * f) * f, of_beta + 8.1748e-2,
      1.8822e-3 - (1.8883e-6 + 4.8697e-7 * f) * f, of_beta + 8.2748e-2, XD, 100 * GFT, GFT, GFT,
      3.203497e-4 + (1.2772337e-11 * psi - 1.0613722e-7) * psi,
      5.0752351e-5 + (8.0614774e-13 * psi - 9.77736719e-10) * psi, over, over);
}
std::shared_ptr<StrengthLaw> uncapped(Real f = 30) {
  return law_from_cards("MAT_CSCM", by_report(f, 5000));
}
/// By the Illinois method, with halving where it is slow.
template <class F>
Real root(Real low, Real high, const F& f) {
  Real at_low = f(low), at_high = f(high);
  const Real width = high - low;
  for (int k = 0; k < 200 && high - low > 1e-15 * width; ++k) {
    const Real x = k % 4 == 3 ? 0.5 * (low + high) : low - (high - low) * at_low / (at_high - at_low);
    const Real value = f(x);
    if (value == 0) return x;
    if ((value > 0) == (at_high > 0))
      high = x, at_high = value, at_low *= 0.5;
    else
      low = x, at_low = value, at_high *= 0.5;
  }
  return 0.5 * (low + high);
}
/// A bar longer by `step`, whose sides are free of stress: their strain by halving, stress grows with it.
void stretch(DrivenPoint& p, Real step) {
  const auto stress = p.stress;
  const auto history = p.history;
  const Real side = root(-8 * std::abs(step), 8 * std::abs(step), [&](Real x) {
    p.stress = stress, p.history = history;
    p.strain({step, x, x, 0, 0, 0});
    return p.stress[1];
  });
  p.stress = stress, p.history = history;
  p.strain({step, side, side, 0, 0, 0});
}
void set(DrivenPoint& p, const std::string& name, Real value) {
  for (std::size_t k = 0; k < p.names.size(); ++k)
    if (p.names[k] == name) p.history[p.first[k]] = value;
}
Real first_invariant(const DrivenPoint& p) {
  return -(p.stress[0] + p.stress[1] + p.stress[2]);
}
Real root_j2(const DrivenPoint& p) {
  const auto& s = p.stress;
  const Real mean = (s[0] + s[1] + s[2]) / 3;
  Real sum = 0;
  for (std::size_t k = 0; k < 6; ++k) sum += k < 3 ? 0.5 * (s[k] - mean) * (s[k] - mean) : s[k] * s[k];
  return std::sqrt(sum);
}

}  // namespace

// s = f/root3 and I = f of a bar in compression; in tension the surface is a triangle in the deviatoric
// plane: s1 - mean = F/root3. Without an element nothing softens.
TEST(Cscm, BarsYieldAtTheSurface) {
  for (const Real f : {20.0, 30.0, 45.0}) {
    const Shear F(f);
    const auto law = uncapped(f);
    const Real crush = root(1, 200, [&](Real x) { return x / root3 - F(x); });
    const Real tear = root(0.01, 20, [&](Real x) { return 2 * x / 3 - F(-x) / root3; });
    EXPECT_GT(tear, 0.05 * f);
    EXPECT_LT(tear, 0.11 * f);
    DrivenPoint pressed(law), pulled(law);
    for (int n = 0; n < 100; ++n) stretch(pressed, -5e-5), stretch(pulled, 5e-6);
    EXPECT_NEAR(-pressed.stress[0], crush, 1e-7 * crush) << f;
    EXPECT_NEAR(pulled.stress[0], tear, 1e-7 * tear) << f;
    EXPECT_EQ(pressed.of("damage"), 0);
  }
}

// What a bar of the automatic parameters bears: the fits of the report are right at 30 MPa, weak at 20, and
// the cap, which stops growing there, makes up for the shear surface at 58.
TEST(CscmConcrete, BarsBearAboutTheirStrength) {
  for (const auto& [f, share] : {std::pair{20.0, 0.85}, {30.0, 1.0}, {45.0, 1.0}, {58.0, 1.0}}) {
    DrivenPoint bar(concrete("1,2.3e-9", f));
    Real top = 0;
    for (int n = 0; n < 100; ++n) stretch(bar, -5e-5), top = std::max(top, -bar.stress[0]);
    EXPECT_NEAR(top, share * f, 0.07 * f) << f;
  }
}

// The card with the strength is the card with the numbers of the report: the same path, cap, rates and damage
// included.
TEST(CscmConcrete, HasTheParametersOfTheReport) {
  for (const Real f : {20.0, 30.0, 58.0}) {
    DrivenPoint given(law_from_cards(
        "MAT_CSCM", by_report(f, 84.85 + (8.769178e-3 * f - 7.3302306e-2) * f, "1,2.3e-9,1,0.0,1"))),
        made(concrete("1,2.3e-9,1,0.0,1", f));
    for (DrivenPoint* p : {&given, &made}) {
      set(*p, "element_size", 20), p->dt = 1e-6;
      for (int n = 0; n < 400; ++n) {
        const Real a = 0.01 * n;
        p->strain({-2e-5 * std::cos(a), 1e-5 * std::sin(a), -1e-5, 5e-5, 0, 2e-6});
      }
    }
    EXPECT_GT(given.of("compaction"), 0);
    EXPECT_GT(given.of("ductile_damage"), 0);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(given.stress[k], made.stress[k], 1e-7 * f) << f;
    for (std::size_t k = 0; k < given.history.size(); ++k)
      EXPECT_NEAR(given.history[k], made.history[k], 1e-8 * (1 + std::abs(made.history[k]))) << k;
  }
}

// Sheared under pressure: s = Q1 F, and along the meridian of extension s = Q2 F, at the pressure that is
// there.
TEST(Cscm, TorsionAndExtensionAreWeaker) {
  const Real f = 30;
  const Shear F(f);
  const Real beta = 2.2655e-4 * f - 1.9972e-5 * f * f;
  const auto Q1 = [&](Real I) {
    return 0.74735 - 0.17 * std::exp(-(beta + 8.1748e-2) * I) +
           (1.5593e-3 - 1.2132e-6 * f - 4.0856e-7 * f * f) * I;
  };
  const auto Q2 = [&](Real I) {
    return 0.66 - 0.16 * std::exp(-(beta + 8.2748e-2) * I) +
           (1.8822e-3 - 1.8883e-6 * f - 4.8697e-7 * f * f) * I;
  };
  for (const Real squeeze : {2e-4, 5e-4}) {
    DrivenPoint torsion(uncapped()), extension(uncapped()), compression(uncapped());
    for (DrivenPoint* p : {&torsion, &extension, &compression})
      p->strain({-squeeze, -squeeze, -squeeze, 0, 0, 0});
    for (int n = 0; n < 200; ++n) {
      torsion.strain({0, 0, 0, 1e-5, 0, 0});
      extension.strain({1e-5, -5e-6, -5e-6, 0, 0, 0});
      compression.strain({-1e-5, 5e-6, 5e-6, 0, 0, 0});
    }
    const Real t = first_invariant(torsion), e = first_invariant(extension), c = first_invariant(compression);
    EXPECT_NEAR(root_j2(torsion), Q1(t) * F(t), 1e-8 * F(t));
    EXPECT_NEAR(root_j2(extension), Q2(e) * F(e), 1e-8 * F(e));
    EXPECT_NEAR(root_j2(compression), F(c), 1e-8 * F(c));
  }
}

// Squeezed all around: I = X of the compaction, and the strain is that and the elastic one.
TEST(Cscm, IsCompactedByPressure) {
  DrivenPoint point(concrete());
  const Real K = 18275 * std::cbrt(3.0) / 2.1, X0 = 84.85 - 7.3302306e-2 * 30 + 8.769178e-3 * 900;
  Real strain = 0;
  for (int n = 0; n < 300; ++n) {
    point.strain({-1e-4, -1e-4, -1e-4, 0, 0, 0});
    strain += 3e-4;
    const Real I = first_invariant(point), y = I - X0;
    if (3 * K * strain < X0) {
      EXPECT_NEAR(I, 3 * K * strain, 1e-9 * I);
      continue;
    }
    const Real compaction = 0.05 * -std::expm1(-2.5e-4 * y - 3.49e-7 * y * y);
    EXPECT_NEAR(point.of("compaction"), compaction, 1e-10);
    EXPECT_NEAR(I / (3 * K) + compaction, strain, 1e-10);
    EXPECT_NEAR(root_j2(point), 0, 1e-9 * I);
  }
  EXPECT_GT(point.of("compaction"), 0.02);
  EXPECT_EQ(point.of("damage"), 0);
}

// With a round surface the return is the state of least complementary energy on it: (I - I_tr)^2/(9 K) + (s -
// s_tr)^2/G, found on a grid. The cap hardly moves.
TEST(Cscm, ReturnIsTheClosestStateOnTheSurface) {
  const Real K = 14000, G = 11000, R = 4, XD = 90;
  const auto law = law_from_cards(
      "MAT_CSCM",
      "1,2.3e-9\n0.0\n11000.0,14000.0,14.0,0.3,10.5,0.02\n1.0,0.0,0.0,0.0,1.0\n4.0,90.0,1e3,1e3\n"
      "100.0,6.0,0.1,0.06,0.06,5.0,1.0\n\n");
  const auto F = [](Real I) { return 14 - 10.5 * std::exp(-0.02 * I) + 0.3 * I; };
  const Real kappa = root(0, XD, [&](Real x) { return x + R * F(x) - XD; });
  const auto surface = [&](Real I) {
    const Real w = std::max((I - kappa) / (XD - kappa), 0.0);
    return F(I) * std::sqrt(std::max(1 - w * w, 0.0));
  };
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> of_I(10, 200), of_s(0, 60), angle(0, 2 * pi);
  int returned = 0;
  for (int n = 0; n < 200; ++n) {
    const Real I = of_I(random), s = of_s(random), a = angle(random);
    DrivenPoint point(law);
    std::array<Real, 6> e{};
    for (std::size_t k = 0; k < 3; ++k)
      e[k] = -I / (9 * K) + s / (2 * G) * 2 / root3 * std::cos(a + 2 * pi * static_cast<Real>(k) / 3);
    point.strain(e);
    if (I < XD && s <= surface(I)) {
      EXPECT_NEAR(first_invariant(point), I, 1e-9);
      continue;
    }
    ++returned;
    const auto energy = [&](Real at, Real t) {
      return (at - I) * (at - I) / (9 * K) + (t - s) * (t - s) / G;
    };
    Real least = energy(0, F(0));
    constexpr int points = 100000;
    for (int k = 0; k <= points; ++k) {
      const Real at = kappa * k / points, w = std::sin(0.5 * pi * k / points), on = kappa + (XD - kappa) * w;
      least = std::min({least, energy(at, F(at)), energy(on, surface(on))});
    }
    const Real found_I = first_invariant(point), found_s = root_j2(point);
    EXPECT_LE(found_s, surface(std::min(found_I, XD)) + 1e-5) << I << " " << s;
    EXPECT_NEAR(energy(found_I, found_s), least, 1e-5 * least + 1e-12) << I << " " << s;
  }
  EXPECT_GT(returned, 100);
}

// The work behind the peak over the area of an element is the fracture energy, whatever its size.
TEST(Cscm, SofteningTakesTheFractureEnergy) {
  const Real GFT = (0.021 + 5.357e-4 * 19) * std::pow(3, 0.7);
  for (const Real size : {5.0, 25.0}) {
    DrivenPoint pulled(concrete()), pressed(concrete());
    set(pulled, "element_size", size), set(pressed, "element_size", size);
    // steps grow, as softening gets slower
    const auto work = [&](DrivenPoint& p, Real first, Real length) {
      Real sum = 0, top = 0, moved = 0;
      for (Real step = first; std::abs(moved) < length; step *= 1.005) {
        const Real before = p.stress[0];
        stretch(p, step / size);
        if (std::abs(p.stress[0]) >= top && p.of("damage") == 0) top = std::abs(p.stress[0]), sum = 0;
        sum += 0.5 * (before + p.stress[0]) * step, moved += step;
      }
      EXPECT_LT(std::abs(p.stress[0]), 0.02 * top);
      return sum;
    };
    EXPECT_NEAR(work(pulled, 1e-5, 0.5), GFT, 0.02 * GFT) << size;
    EXPECT_NEAR(work(pressed, -1e-4, 3), 100 * GFT, 0.02 * 100 * GFT) << size;
  }
}

// Torn, then pressed: brittle damage is forgotten under pressure with RECOV 0, stays with 1, by half with
// 0.5; it is back in tension.
TEST(Cscm, CracksClose) {
  const Real E = 18275 * std::cbrt(3.0);
  for (const Real recov : {0.0, 0.5, 1.0}) {
    DrivenPoint point(concrete(fmt::format("1,2.3e-9,1,0.0,0,0.0,{}", recov)));
    set(point, "element_size", 20);
    for (int n = 0; n < 600; ++n) stretch(point, 1e-6);
    const Real D = point.of("brittle_damage"), before = point.stress[0];
    EXPECT_GT(D, 0.25);
    stretch(point, -1e-6);
    EXPECT_NEAR(before - point.stress[0], (1 - D) * E * 1e-6, 1e-9);
    while (point.stress[0] > -1) stretch(point, -1e-6);
    const Real pressed = point.stress[0];
    stretch(point, -1e-6);
    EXPECT_NEAR(pressed - point.stress[0], (1 - recov * D) * E * 1e-6, 1e-9) << recov;
    while (point.stress[0] < 0.1) stretch(point, 1e-6);
    EXPECT_EQ(point.of("damage"), D);
  }
}

// A round cylinder s = ALPHA, whose bars bear 3 G eta rate more: eta = ETA0 rate^-N, with the overstress E
// rate eta below its limit.
TEST(Cscm, RatesRaiseTheStrength) {
  const Real K = 14000, G = 11000, E = 9 * K * G / (3 * K + G), f = 4 * root3;
  for (const Real most : {0.0, 2.0}) {
    const auto law = law_from_cards(
        "MAT_CSCM",
        fmt::format("1,2.3e-9,1,0.0,1\n0.0\n11000.0,14000.0,4.0,0.0,0.0,0.0\n1.0,0.0,0.0,0.0,1.0\n4.0,1e4,"
                    "0.05,1e-4,1e-8\n100.0,6.0,0.1,0.06,0.06,5.0,1.0\n1e-4,0.78,6e-5,0.48,{0},{0},1.0\n",
                    most));
    for (const Real rate : {1.0, 10.0}) {
      DrivenPoint pressed(law);
      pressed.dt = 1e-7;
      for (int n = 0; n < 30000 / rate; ++n) stretch(pressed, -rate * 1e-7);
      Real eta = 1e-4 * std::pow(rate, -0.78);
      if (most > 0) eta = std::min(eta, most / (E * rate));
      EXPECT_NEAR(-pressed.stress[0] - f, 3 * G * eta * rate, 5e-3 * 3 * G * eta * rate)
          << most << " " << rate;
    }
  }
}

// Damage 0.99 and a principal strain of 5 % delete a point with ERODE 1.05; never with ERODE 0.
TEST(Cscm, Erodes) {
  for (const Real erode : {0.0, 1.0, 1.05}) {
    DrivenPoint point(concrete(fmt::format("1,2.3e-9,1,0.0,0,{}", erode)));
    set(point, "element_size", 50);
    Real strain = 0;
    while (point.of("failure_ratio") < 1 && strain < 0.07) stretch(point, 1e-4), strain += 1e-4;
    if (erode == 0) {
      EXPECT_GT(strain, 0.069);
    } else if (erode == 1) {
      EXPECT_GT(point.of("damage"), 0.99);
      EXPECT_LT(strain, 0.05);
    } else {
      EXPECT_NEAR(strain, 0.05, 2.1e-4);
    }
    EXPECT_EQ(std::isfinite(point.law->failure_limit()), erode >= 1);
  }
}

// The same concrete in all systems of units.
TEST(CscmConcrete, UnitsAreOneMaterial) {
  struct Units {
    const char* cards;
    Real stress, size, time;
  };
  constexpr Real psi = 145.0377377;
  const Units all[] = {{"1,2.3e-6,1,0.0,1\n0.0\n0.03,19.0,0\n", 1e-3, 20, 1e3},
                       {"1,2.3e-3,1,0.0,1\n0.0\n30.0,19.0,1\n", 1, 20, 1e3},
                       {"1,2.3e-9,1,0.0,1\n0.0\n30.0,19.0,2\n", 1, 20, 1},
                       {"1,2.15e-4,1,0.0,1\n0.0\n4351.132131,0.7480314961,3\n", psi, 20 / 25.4, 1},
                       {"1,2300.0,1,0.0,1\n0.0\n3e7,0.019,4\n", 1e6, 0.02, 1},
                       {"1,2300.0,1,0.0,1\n0.0\n0.0,0.0,4\n", 1e6, 0.02, 1}};
  Real first = 0, damage = 0;
  for (const Units& u : all) {
    DrivenPoint point(law_from_cards("MAT_CSCM_CONCRETE", u.cards));
    set(point, "element_size", u.size);
    point.dt = 1e-7 * u.time;
    for (int n = 0; n < 300; ++n) point.strain({2e-6, -1e-7, 3e-7, 1e-7, 0, 0});
    if (first == 0) first = point.stress[0] / u.stress, damage = point.of("damage");
    EXPECT_NEAR(point.stress[0] / u.stress, first, 1e-6 * first) << u.cards;
    EXPECT_NEAR(point.of("damage"), damage, 1e-6) << u.cards;
    EXPECT_GT(damage, 0.05);
  }
}

// The rate is that of the deviator, which is round-off here: the cap flows all the same.
TEST(CscmConcrete, RoundOffOfTheDeviatorDecidesNothingUnderPressure) {
  std::vector<Real> pressures;
  for (const Real deviator : {0.0, 1e-15, 1e-9, 1e-6}) {
    DrivenPoint point(concrete("1,2.3e-9,,,1"));
    point.dt = 1e-5;
    for (int k = 0; k < 100; ++k) point.strain({-1e-4 * (1 + deviator), -1e-4, -1e-4, 0, 0, 0});
    pressures.push_back(-(point.stress[0] + point.stress[1] + point.stress[2]) / 3);
  }
  for (const Real p : pressures) EXPECT_NEAR(p, pressures[0], 1e-4 * pressures[0]);
  EXPECT_LT(pressures[0], 0.9 * 0.03 * concrete()->bulk_modulus()) << "elastic";
}

}  // namespace cscm_test
