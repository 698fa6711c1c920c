// Failure by the state of stress: *MAT_TABULATED_JOHNSON_COOK and *MAT_ADD_DAMAGE_GISSMO against closed
// forms.
#include "laws/failure/fracture_strain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "driven_point.hpp"
#include "law_from_cards.hpp"

namespace fracture_strain_test {

using namespace courant;
using test::DrivenPoint;
using test::law_from_cards;

namespace {

void set(DrivenPoint& p, const std::string& name, Real value) {
  for (std::size_t k = 0; k < p.names.size(); ++k)
    if (p.names[k] == name) p.history[p.first[k]] = value;
}
std::vector<std::size_t> sides(bool plane) {
  return plane ? std::vector<std::size_t>{1} : std::vector<std::size_t>{1, 2};
}
/// A curve with this number.
std::string curve(int id, const std::string& points) {
  return fmt::format("*DEFINE_CURVE\n{}\n{}", id, points);
}

/// Yield stress 300 + 500 e, 10 % more at a rate of 100, 20 % less 100 degrees warmer.
const std::string yields = curve(1, "0.0,300.0\n1.0,800.0\n") + curve(2, "0.0,330.0\n1.0,880.0\n") +
                           curve(3, "0.0,240.0\n1.0,640.0\n") + "*DEFINE_TABLE_2D\n10\n0.0,1\n100.0,2\n" +
                           "*DEFINE_TABLE_2D\n11\n300.0,1\n400.0,3\n";
constexpr Real heat = 1 / (7.8e-9 * 4.5e8);

/// *MAT_PIECEWISE_LINEAR_PLASTICITY with the yield stress 300 + 500 e, behind a *MAT_ADD_DAMAGE_GISSMO.
std::shared_ptr<StrengthLaw> damaged(const std::string& cards, const std::string& curves) {
  return law_from_cards("MAT_ADD_DAMAGE_GISSMO",
                        cards + "*MAT_PIECEWISE_LINEAR_PLASTICITY\n1,7.8e-9,2e5,0.3\n,,1\n\n\n" +
                            curve(1, "0.0,300.0\n1.0,800.0\n") + curves);
}

}  // namespace

TEST(StressState, IsThatOfBasicStates) {
  const auto at = [](const std::array<Real, 6>& s) { return StressState::of(s); };
  EXPECT_NEAR(at({2, 0, 0}).triaxiality, 1.0 / 3, 1e-15);
  EXPECT_NEAR(at({2, 0, 0}).lode, 1, 1e-15);
  EXPECT_NEAR(at({0, -2, 0}).triaxiality, -1.0 / 3, 1e-15);
  EXPECT_NEAR(at({0, -2, 0}).lode, -1, 1e-15);
  EXPECT_NEAR(at({3, 3, 0}).triaxiality, 2.0 / 3, 1e-15);
  EXPECT_NEAR(at({3, 3, 0}).lode, -1, 1e-15);
  EXPECT_NEAR(at({0, 0, 0, 0, 1, 0}).triaxiality, 0, 1e-15);
  EXPECT_NEAR(at({0, 0, 0, 1, 0, 0}).lode, 0, 1e-15);
  EXPECT_EQ(at({}).triaxiality, 0);
}

// Yield stress by tables, heat by plastic work, damage by the sum of de over the product of the tables.
TEST(TabulatedJohnsonCook, BarsFollowTheirTables) {
  const std::string cards = "1,7.8e-9,2e5,0.3,4.5e8,300.0,0.9\n10,11,20,21,22,23\n\n" + yields +
                            curve(20, "-1.0,0.2\n0.0,0.8\n1.0,2.0\n") + curve(21, "0.0,1.0\n100.0,3.0\n") +
                            curve(22, "300.0,1.0\n400.0,2.0\n") + curve(23, "1.0,1.0\n5.0,0.5\n");
  const auto law = law_from_cards("MAT_TABULATED_JOHNSON_COOK", cards);
  for (const bool plane : {false, true})
    for (const Real sign : {1.0, -1.0}) {
      DrivenPoint bar(law, plane);
      set(bar, "element_size", 3);
      bar.dt = 1e-5;
      Real e = 0, rise = 0, D = 0;
      for (int k = 0; k < 200; ++k) {
        bar.strain_with_free({sign * 5e-4, sign * -2e-4, sign * -2e-4, 0, 0, 0}, sides(plane));
        const Real now = bar.of("plastic_strain"), de = now - e, rate = de / bar.dt;
        if (de > 0) {
          const Real q = (300 + 500 * now) * (1 + 0.1 * std::min(rate / 100, 1.0)) *
                         (1 - 0.2 * std::min(rise / 100, 1.0));
          EXPECT_NEAR(sign * bar.stress[0], q, 1e-6 * q) << k;
          // pressure/q is -1/3 in tension
          const Real of_stress = sign > 0 ? 0.6 : 1.2;
          D +=
              de / (of_stress * (1 + 2 * std::min(rate / 100, 1.0)) * (1 + std::min(rise / 100, 1.0)) * 0.75);
          rise += 0.9 * heat * q * de;
        }
        e = now;
        EXPECT_NEAR(bar.of("temperature_rise"), rise, 1e-5 * (1 + rise));
        EXPECT_NEAR(bar.of("damage"), D, 1e-6);
      }
      EXPECT_GT(rise, 5);
      EXPECT_GT(D, 0.03);
      EXPECT_EQ(law->failure_limit(), 1);
    }
}

// A table of failure strains over 27 J3/(2 q^3): tension 1, shear 0, compression -1. ERODE 1 leaves a fluid.
TEST(TabulatedJohnsonCook, FailureKnowsTheLodeParameter) {
  const std::string cards = "1,7.8e-9,2e5,0.3\n1,0,30\n,,,1\n" + yields + curve(31, "-1.0,0.1\n1.0,0.1\n") +
                            curve(32, "-1.0,0.2\n1.0,0.2\n") + curve(33, "-1.0,0.4\n1.0,0.4\n") +
                            "*DEFINE_TABLE_2D\n30\n-1.0,31\n0.0,32\n1.0,33\n";
  const auto law = law_from_cards("MAT_TABULATED_JOHNSON_COOK", cards);
  DrivenPoint pulled(law), pressed(law), sheared(law);
  for (int k = 0; k < 100; ++k) {
    pulled.strain_with_free({5e-4, -2e-4, -2e-4, 0, 0, 0}, {1, 2});
    pressed.strain_with_free({-5e-4, 2e-4, 2e-4, 0, 0, 0}, {1, 2});
    sheared.strain({0, 0, 0, 5e-4, 0, 0});
  }
  EXPECT_NEAR(pulled.of("damage"), pulled.of("plastic_strain") / 0.4, 1e-9);
  EXPECT_NEAR(pressed.of("damage"), pressed.of("plastic_strain") / 0.1, 1e-9);
  EXPECT_NEAR(sheared.of("damage"), sheared.of("plastic_strain") / 0.2, 1e-9);
  EXPECT_FALSE(std::isfinite(law->failure_limit()));
  for (int k = 0; k < 500; ++k) sheared.strain({-1e-5, -1e-5, -1e-5, 5e-4, 0, 0});
  EXPECT_GE(sheared.of("damage"), 1);
  EXPECT_EQ(sheared.stress[3], 0);
  EXPECT_LT(sheared.stress[0], -100);
}

// D^(1/n) is the plastic strain over that of the state of stress, times the factors of size and rate; stress
// fades from DCRIT on with the exponent FADEXP.
TEST(Gissmo, StressFadesByDamage) {
  const auto law = damaged(
      "1,,1\n5,0.0,2.0,0.1,1.5,6\n7\n",
      curve(5, "-0.5,1.0\n0.5,0.2\n") + curve(6, "1.0,1.0\n5.0,0.5\n") + curve(7, "0.0,1.0\n10.0,3.0\n"));
  for (const bool plane : {false, true}) {
    DrivenPoint bar(law, plane);
    set(bar, "element_size", 3);
    bar.dt = 1e-4;
    Real e = 0, root = 0;
    for (int k = 0; k < 600; ++k) {
      const auto step = bar.strain_with_free({5e-4, -2e-4, -2e-4, 0, 0, 0}, sides(plane));
      const Real now = bar.of("plastic_strain"), z = plane ? bar.rate_zz * bar.dt : step[2];
      const Real rate = std::sqrt(2.0 / 3 * (step[0] * step[0] + step[1] * step[1] + z * z)) / bar.dt;
      // triaxiality 1/3: 1 - 0.8 (1/3 + 1/2)
      root += (now - e) / ((1 - 0.8 * 5.0 / 6) * 0.75 * (1 + 2 * std::min(rate / 10, 1.0)));
      const Real D = std::min(root * root, 1.0), left = D > 0.1 ? 1 - std::pow((D - 0.1) / 0.9, 1.5) : 1;
      EXPECT_NEAR(bar.of("damage"), D, plane ? 1e-3 : 1e-7) << k;
      EXPECT_NEAR(bar.stress[0], left * (now > 0 ? 300 + 500 * now : bar.stress[0]), plane ? 1 : 1e-3) << k;
      EXPECT_NEAR(bar.of("failure_ratio"), bar.of("damage"), 1e-12);
      e = now;
      if (D >= 1) break;
    }
    EXPECT_GT(root, 0.5);
  }
}

// With a curve of ECRIT fading begins where the instability is 1, at the damage that is there; in
// compression, where the curve is higher, later.
TEST(Gissmo, FadingBeginsAtTheInstability) {
  const auto law = damaged("1,,1\n5,-8.0,1.0,0.0,1.0\n\n",
                           curve(5, "-0.5,0.6\n0.5,0.4\n") + curve(8, "-0.5,0.3\n0.5,0.1\n"));
  for (const Real sign : {1.0, -1.0}) {
    DrivenPoint bar(law);
    const Real t = sign / 3, fracture = 0.5 - 0.2 * t, unstable = 0.2 - 0.2 * t;
    Real first = 0;
    for (int k = 0; k < 700; ++k) {
      const Real before = bar.of("instability");
      bar.strain_with_free({sign * 5e-4, sign * -2e-4, sign * -2e-4, 0, 0, 0}, {1, 2});
      const Real e = bar.of("plastic_strain");
      if (!(e > 0)) continue;
      EXPECT_NEAR(bar.of("instability"), std::min(e / unstable, 1.0), 1e-6);
      EXPECT_NEAR(bar.of("damage"), std::min(e / fracture, 1.0), 1e-6);
      if (before < 1 && bar.of("instability") >= 1) first = bar.of("damage");
      const Real left = first > 0 ? 1 - (bar.of("damage") - first) / (1 - first) : 1;
      EXPECT_NEAR(sign * bar.stress[0], left * (300 + 500 * e), 0.01) << k;
      if (bar.of("damage") > 0.95) break;
    }
    EXPECT_NEAR(first, unstable / fracture, 3e-3);
  }
}

// DTYP 0 counts damage and nothing else.
TEST(Gissmo, MayOnlyCount) {
  const auto law = damaged("1,,0\n5,0.0,1.0,0.0,1.0\n\n", curve(5, "-0.5,0.05\n0.5,0.05\n"));
  DrivenPoint bar(law);
  for (int k = 0; k < 200; ++k) bar.strain_with_free({5e-4, -2e-4, -2e-4, 0, 0, 0}, {1, 2});
  EXPECT_EQ(bar.of("damage"), 1);
  EXPECT_EQ(bar.of("failure_ratio"), 0);
  EXPECT_NEAR(bar.stress[0], 300 + 500 * bar.of("plastic_strain"), 1e-6);
}

// Two numbers of one name would be one number: the material's sum of de/0.5 and that of de/0.3.
TEST(Gissmo, HasADamageOfItsOwnBesideThatOfTheMaterial) {
  const auto law = law_from_cards(
      "MAT_ADD_DAMAGE_GISSMO",
      "1,,1\n5,0.0,1.0,1.0,1.0\n\n*MAT_TABULATED_JOHNSON_COOK\n1,7.8e-9,2e5,0.3,,,0.0\n10,,20\n\n" + yields +
          curve(5, "-1.0,0.3\n1.0,0.3\n") + curve(20, "-1.0,0.5\n1.0,0.5\n"));
  DrivenPoint bar(law);
  for (int k = 0; k < 200; ++k) bar.strain_with_free({5e-4, -2e-4, -2e-4, 0, 0, 0}, {1, 2});
  const Real e = bar.of("plastic_strain");
  EXPECT_GT(e, 0.05);
  EXPECT_NEAR(bar.of("damage"), e / 0.5, 1e-6);
  EXPECT_NEAR(bar.of("damage_2"), e / 0.3, 1e-6);
  EXPECT_EQ(law->failure_variable(), law->history().back().name);
}

}  // namespace fracture_strain_test
