// *MAT_MODIFIED_JOHNSON_COOK against its formulas, step by step, in solids and in the plane.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "driven_point.hpp"
#include "law_from_cards.hpp"

namespace modified_johnson_cook_test {

using namespace courant;
using test::DrivenPoint;
using test::law_from_cards;

namespace {

constexpr Real E = 2e5, nu = 0.3, ro = 7.85e-9, xsi = 0.9, cp = 4.52e8, expansion = 1.1e-5, rate0 = 0.01;
constexpr Real A = 490, B = 383, n = 0.45, C = 0.0123, M = 0.94, Q1 = 90, C1 = 20, Q2 = 40, C2 = 3;
constexpr Real D1 = 0.0705, D2 = 1.732, D3 = -0.54, D4 = -0.015, D5 = 0.4, PD = 0.02;
constexpr Real TR = 293, TM = 1800, T0 = 350;

std::string cards(Real beta, Real dc, Real tc = 0, Real tauc = 0) {
  return fmt::format(
      "1,{},{},{},{},{},{},{}\n{},{},{},{},0,0\n{},{},{},{},{}\n{},{},{},{}\n{},{},{},{},{},{},{}\n{},{}\n",
      ro, E, nu, beta, xsi, cp, expansion, rate0, TR, TM, T0, A, B, n, C, M, Q1, C1, Q2, C2, dc, PD, D1, D2,
      D3, D4, D5, tc, tauc);
}
Real flow(Real e, Real rate, Real T) {
  const Real hard = A + B * std::pow(e, n) + Q1 * (1 - std::exp(-C1 * e)) + Q2 * (1 - std::exp(-C2 * e));
  return hard * std::pow(1 + rate / rate0, C) * (1 - std::pow((T - TR) / (TM - TR), M));
}
const std::vector<std::size_t> around{1, 2}, beside{1};

}  // namespace

// A bar: q by hardening, rate and temperature; heat, expansion and damage by their sums. With BETA 1 damage
// weakens.
TEST(ModifiedJohnsonCook, BarsFollowTheFlowStress) {
  for (const Real beta : {0.0, 1.0})
    for (const bool plane : {false, true}) {
      DrivenPoint bar(law_from_cards("MAT_MODIFIED_JOHNSON_COOK", cards(beta, 0.6)), plane);
      bar.dt = 1e-5;
      Real T = T0, D = 0, last = 0, volume = 0;
      for (int k = 0; k < 400; ++k) {
        const auto step = bar.strain_with_free({5e-4, -2e-4, -2e-4, 0, 0, 0}, plane ? beside : around);
        volume += step[0] + step[1] + (plane ? bar.rate_zz * bar.dt : step[2]);
        const Real e = bar.of("plastic_strain"), de = e - last, rate = de / bar.dt;
        if (de > 0) {
          const Real q = flow(e, rate, T);
          const Real fracture =
              (D1 + D2 * std::exp(D3 / 3)) * std::pow(1 + rate / rate0, D4) * (1 + D5 * (T - TR) / (TM - TR));
          const Real old = D;
          D += 0.6 * std::min(de, std::max(e - PD, 0.0)) / (fracture - PD);
          EXPECT_NEAR(bar.stress[0], (1 - beta * D) * q, 2e-6 * q) << k;
          T += xsi / (ro * cp) * (1 - beta * old) * q * de;
        }
        last = e;
        EXPECT_NEAR(bar.of("temperature_rise"), T - T0, 1e-5 * (1 + T - T0));
        EXPECT_NEAR(bar.of("damage"), D, 1e-6);
      }
      EXPECT_GT(T, T0 + 20);
      EXPECT_GT(D, 0.05);
      if (beta == 0) {
        EXPECT_NEAR(volume, bar.stress[0] * (1 - 2 * nu) / E + 3 * expansion * (T - T0), 1e-7);
      }
    }
}

// The work of the largest tension over WC; none in compression.
TEST(ModifiedJohnsonCook, CockcroftAndLathamCountTension) {
  const auto law = law_from_cards("MAT_MODIFIED_JOHNSON_COOK",
                                  "1,7.85e-9,2e5,0.3\n0.01,,,,0,1\n490.0,383.0,0.45\n\n0.7,200.0\n\n");
  for (const bool plane : {false, true}) {
    DrivenPoint pulled(law, plane), pressed(law, plane), sheared(law, plane);
    Real work = 0, shear = 0;
    for (int k = 0; k < 300; ++k) {
      const Real before = pulled.of("plastic_strain"), sheared_before = sheared.of("plastic_strain");
      pulled.strain_with_free({1e-3, -5e-4, -5e-4, 0, 0, 0}, plane ? beside : around);
      pressed.strain_with_free({-1e-3, 5e-4, 5e-4, 0, 0, 0}, plane ? beside : around);
      sheared.strain({0, 0, 0, 1e-3, 0, 0});
      work += pulled.stress[0] * (pulled.of("plastic_strain") - before);
      shear += sheared.stress[3] * (sheared.of("plastic_strain") - sheared_before);
    }
    EXPECT_NEAR(pulled.of("damage"), work / 200, 1e-8);
    EXPECT_NEAR(sheared.of("damage"), shear / 200, 1e-8);
    EXPECT_NEAR(pressed.of("damage"), 0, 1e-9);
    EXPECT_EQ(law->failure_limit(), 0.7);
  }
}

// A point fails by damage over DC, by the temperature over TC, by the shear stress over TAUC, whichever is
// first.
TEST(ModifiedJohnsonCook, FailsByHeatAndShearToo) {
  DrivenPoint hot(law_from_cards("MAT_MODIFIED_JOHNSON_COOK", cards(0, 1, 370)));
  DrivenPoint sheared(law_from_cards("MAT_MODIFIED_JOHNSON_COOK", cards(0, 1, 0, 500)));
  for (int k = 0; k < 200; ++k) {
    hot.strain_with_free({-5e-4, 2e-4, 2e-4, 0, 0, 0}, around);
    sheared.strain_with_free({5e-4, -2e-4, -2e-4, 0, 0, 0}, around);
  }
  EXPECT_EQ(hot.law->failure_variable(), "failure_ratio");
  EXPECT_NEAR(hot.of("failure_ratio"), std::max(hot.of("temperature_rise") / 20, hot.of("damage")), 1e-12);
  EXPECT_NEAR(sheared.of("failure_ratio"), std::max(sheared.stress[0] / 1000, sheared.of("damage")), 1e-6);
  EXPECT_GT(hot.of("temperature_rise") / 20, hot.of("damage"));
}

}  // namespace modified_johnson_cook_test
