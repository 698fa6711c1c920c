// Ceramics and concrete of Johnson, Holmquist and Cook against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "driven_point.hpp"
#include "law_from_cards.hpp"

using namespace courant;
using test::DrivenPoint;
using test::law_from_cards;

namespace {

/// Alumina (Anderson, Johnson & Holmquist 1995), GPa, mm, g/mm^3: without influence of the rate.
std::string alumina(Real beta, Real d1, Real k2 = 0, Real k3 = 0) {
  return fmt::format(
      "1,3.89e-3,90.16,0.93,0.31,0.0,0.6,0.6\n0.0,0.2,1e20,2.79,1.46,{}\n{},1.0,130.95,{},{},0\n", beta, d1,
      k2, k3);
}
constexpr Real hel = 1.5 * (2.79 - 1.46);
Real mean(const DrivenPoint& p) {
  return (p.stress[0] + p.stress[1] + p.stress[2]) / 3;
}

/// FC 48 MPa (Holmquist, Johnson & Cook 1993), in MPa.
const std::string concrete =
    "1,2.44e-9,14860.0,0.79,1.60,0.0,0.61,48.0\n4.0,1.0,0.01,7.0,16.0,0.001,800.0,0.10\n"
    "0.04,1.0,85000.0,-171000.0,208000.0,0\n";

}  // namespace

// Squeezed in one direction: pressure K1 mu + K2 mu^2 + K3 mu^3, deviator by elasticity up to A (P* + T*)^N,
// then that.
TEST(JohnsonHolmquistCeramics, IntactStrengthFollowsThePressure) {
  DrivenPoint point(law_from_cards("MAT_JOHNSON_HOLMQUIST_CERAMICS", alumina(0, 1e9, 100, 50)));
  for (int n = 1; n <= 100; ++n) {
    point.strain({-1e-3, 0, 0, 0, 0, 0});
    const Real mu = std::exp(1e-3 * n) - 1, p = 130.95 * mu + 100 * mu * mu + 50 * mu * mu * mu;
    EXPECT_NEAR(-mean(point), p, 1e-10);
    const Real q = std::abs(point.stress[0] - point.stress[1]);
    const Real strength = hel * 0.93 * std::pow((p + 0.2) / 1.46, 0.6);
    EXPECT_NEAR(q, std::min(2 * 90.16 * 1e-3 * n, strength), 1e-9) << n;
  }
  EXPECT_GT(point.of("plastic_strain"), 0.03);
  EXPECT_LT(point.of("damage"), 1e-9);
}

// At a steady pressure damage is the plastic strain over D1 (P* + T*)^D2, strength goes from intact to broken
// with it.
TEST(JohnsonHolmquistCeramics, BreaksByPlasticStrain) {
  DrivenPoint point(law_from_cards("MAT_JOHNSON_HOLMQUIST_CERAMICS", alumina(0, 0.01)));
  for (int n = 0; n < 10; ++n) point.strain({-1e-3, -1e-3, -1e-3, 0, 0, 0});
  const Real p = -mean(point), P = p / 1.46, T = 0.2 / 1.46;
  const Real intact = 0.93 * std::pow(P + T, 0.6), broken = 0.31 * std::pow(P, 0.6);
  for (int n = 0; n < 1500; ++n) {
    const Real D = point.of("damage");
    point.strain({0, 0, 0, 1e-4, 0, 0});
    EXPECT_NEAR(-mean(point), p, 1e-10);
    EXPECT_NEAR(point.of("damage"), std::min(point.of("plastic_strain") / (0.01 * (P + T)), 1.0), 1e-10);
    if (D > 0) {
      EXPECT_NEAR(std::sqrt(3.0) * point.stress[3], hel * (intact - D * (intact - broken)), 1e-9) << n;
    }
  }
  EXPECT_EQ(point.of("damage"), 1);
}

// Broken under pressure it swells: p'^2 = p^2 + 2 BETA K1 (U of intact - U of broken), U = q^2/(6 G), in the
// limit of many steps, each of which has its own p. Without tension left, once broken.
TEST(JohnsonHolmquistCeramics, SwellsAndBearsNoTensionOnceBroken) {
  for (const Real beta : {0.5, 1.0}) {
    DrivenPoint point(law_from_cards("MAT_JOHNSON_HOLMQUIST_CERAMICS", alumina(beta, 1e-9)));
    for (int n = 0; n < 10; ++n) point.strain({-1e-3, -1e-3, -1e-3, 0, 0, 0});
    const Real p = -mean(point), P = p / 1.46, T = 0.2 / 1.46;
    const Real intact = hel * 0.93 * std::pow(P + T, 0.6), broken = hel * 0.31 * std::pow(P, 0.6);
    for (int n = 0; n < 200 && point.of("damage") < 1; ++n) point.strain({0, 0, 0, 1e-3, 0, 0});
    point.strain({0, 0, 0, 0, 0, 0});
    const Real lost = (intact * intact - broken * broken) / (6 * 90.16);
    EXPECT_NEAR(-mean(point), std::sqrt(p * p + 2 * beta * 130.95 * lost), 1e-9);
    for (int n = 0; n < 100; ++n) point.strain({1e-3, 1e-3, 1e-3, 0, 0, 0});
    EXPECT_NEAR(mean(point), 0, 1e-12);
  }
  // whole it bears T
  DrivenPoint whole(law_from_cards("MAT_JOHNSON_HOLMQUIST_CERAMICS", alumina(0, 1)));
  for (int n = 0; n < 100; ++n) whole.strain({1e-3, 1e-3, 1e-3, 0, 0, 0});
  EXPECT_NEAR(mean(whole), 0.2, 1e-12);
  EXPECT_EQ(whole.of("torn"), 1);
}

// Pressure over mu of the paper: elastic, crushed, dense; unloading by a slope between, and back to where it
// was left.
TEST(JohnsonHolmquistConcrete, IsCrushedForGood) {
  DrivenPoint point(law_from_cards("MAT_JOHNSON_HOLMQUIST_CONCRETE", concrete));
  const Real steps = 2000;
  Real root = 800.0 / 85000;  // K1 x - |K2| x^2 + K3 x^3 = 800
  for (int k = 0; k < 50; ++k)
    root -= (85000 * root - 171000 * root * root + 208000 * root * root * root - 800) /
            (85000 - 2 * 171000 * root + 3 * 208000 * root * root);
  const Real locks = 0.1 + root * 1.1;
  const auto expected = [&](Real mu) {
    if (mu < 0.001) return 16000 * mu;
    if (mu < locks) return 16 + 784 * (mu - 0.001) / (locks - 0.001);
    const Real x = (mu - 0.1) / 1.1;
    return 85000 * x - 171000 * x * x + 208000 * x * x * x;
  };
  Real volume = 0;
  const auto squeeze = [&](Real by) {
    point.strain({by / 3, by / 3, by / 3, 0, 0, 0});
    volume += by;
    return std::expm1(-volume);
  };
  for (int n = 0; n < steps; ++n) {
    const Real mu = squeeze(-0.05 / steps);
    EXPECT_NEAR(-mean(point), expected(mu), 1e-8 * expected(mu));
  }
  // half of it back, and to the top again
  const Real top = std::expm1(-volume), p = -mean(point), share = (top - 0.001) / (locks - 0.001);
  const Real back = (1 - share) * 16000 + share * 85000;
  Real mu = squeeze(0.003);
  EXPECT_NEAR(-mean(point), p - back * (top - mu), 1e-8 * p);
  mu = squeeze(-0.003);
  EXPECT_NEAR(-mean(point), p, 1e-8 * p);
  for (int n = 0; n < steps; ++n) {
    mu = squeeze(-0.15 / steps);
    EXPECT_NEAR(-mean(point), expected(mu), 1e-8 * expected(mu));
  }
  // dense: back by K1, and no more tension than the broken concrete bears
  const Real high = -mean(point), at = mu;
  mu = squeeze(0.001);
  EXPECT_NEAR(-mean(point), high - 85000 * (at - mu), 1e-8 * high);
  const Real D = point.of("damage");
  EXPECT_GT(D, 0.1);
  EXPECT_LT(D, 1);
  for (int n = 0; n < 100; ++n) squeeze(0.01);
  EXPECT_NEAR(mean(point), 4 * (1 - D), 1e-9);
}

// Shear at a steady pressure: FC (A (1 - D) + B P*^N), D by the plastic strain over D1 (P* + T*), at least
// EFMIN.
TEST(JohnsonHolmquistConcrete, LosesItsCohesion) {
  DrivenPoint point(law_from_cards("MAT_JOHNSON_HOLMQUIST_CONCRETE", concrete));
  for (int n = 0; n < 10; ++n) point.strain({-2e-5, -2e-5, -2e-5, 0, 0, 0});
  const Real p = -mean(point), P = p / 48;
  EXPECT_NEAR(p, 16000 * std::expm1(6e-4), 1e-9);
  const Real breaks = std::max(0.04 * (P + 4.0 / 48), 0.01);
  for (int n = 0; n < 400; ++n) {
    const Real D = point.of("damage");
    point.strain({0, 0, 0, 1e-4, 0, 0});
    EXPECT_NEAR(point.of("damage"), std::min(point.of("plastic_strain") / breaks, 1.0), 1e-10);
    if (D > 0) {
      EXPECT_NEAR(std::sqrt(3.0) * point.stress[3], 48 * (0.79 * (1 - D) + 1.6 * std::pow(P, 0.61)), 1e-8)
          << n;
    }
  }
  EXPECT_EQ(point.of("damage"), 1);
}
