// *MAT_SOIL_AND_FOAM and *MAT_SOIL_AND_FOAM_FAILURE against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "driven_point.hpp"
#include "law_from_cards.hpp"

namespace soil_test {

using namespace courant;
using test::DrivenPoint;
using test::law_from_cards;

namespace {

/// p = 40 e up to 0.05, then through (0.1, 3), (0.3, 20). G = 15, BULK = 110, PC = -0.2.
const std::string points = "0.0,-0.05,-0.1,-0.3\n\n0.0,2.0,3.0,20.0\n\n";
std::shared_ptr<StrengthLaw> soil(const std::string& strength, const std::string& vcr = "",
                                  const std::string& keyword = "MAT_SOIL_AND_FOAM") {
  return law_from_cards(keyword, "1,2e-9,15.0,110.0," + strength + ",-0.2\n" + vcr + "\n" + points);
}
Real table(Real e) {
  return e < 0.05 ? 40 * e : e < 0.1 ? 2 + 20 * (e - 0.05) : 3 + 85 * (e - 0.1);
}
Real pressure(const DrivenPoint& p) {
  return -(p.stress[0] + p.stress[1] + p.stress[2]) / 3;
}
Real J2(const DrivenPoint& p) {
  Real sum = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const Real s = p.stress[k] + (k < 3 ? pressure(p) : 0);
    sum += (k < 3 ? 0.5 : 1) * s * s;
  }
  return sum;
}
void press(DrivenPoint& p, Real by, int steps) {
  for (int n = 0; n < steps; ++n) p.strain({-by / 3, -by / 3, -by / 3, 0, 0, 0});
}

}  // namespace

TEST(Soil, PressureIsThatOfTheTableAndGoesBackByBulk) {
  for (const bool crushes : {true, false}) {
    DrivenPoint point(soil("1.0,0.5,0.0", crushes ? "" : "1.0"));
    Real most = 0;
    for (int n = 0; n < 350; ++n) {
      press(point, 1e-3, 1), most += 1e-3;
      EXPECT_NEAR(pressure(point), table(most), 1e-11);
      if (n % 50 != 49) continue;
      press(point, -1e-3, 10);
      EXPECT_NEAR(pressure(point), crushes ? std::max(table(most) - 110 * 0.01, -0.2) : table(most - 0.01),
                  1e-11);
      press(point, 1e-3, 10);
      EXPECT_NEAR(pressure(point), table(most), 1e-11);
    }
  }
}

TEST(Soil, StrengthFollowsThePressure) {
  for (const auto& [a0, a1, a2] :
       {std::array{1.0, 0.5, 0.0}, {0.3, 0.2, 0.4}, {0.0, 0.0, 0.6}, {4.0, 0.0, 0.0}}) {
    for (const Real to : {0.02, 0.08, 0.2}) {
      DrivenPoint point(soil(fmt::format("{},{},{}", a0, a1, a2)));
      press(point, to, 1);
      for (int n = 0; n < 100; ++n) point.strain({2e-3, -1e-3, -1e-3, 4e-3, 0, 1e-3});
      const Real p = table(to);
      EXPECT_NEAR(J2(point), a0 + a1 * p + a2 * p * p, 1e-9 * (1 + p * p)) << to;
      EXPECT_NEAR(pressure(point), p, 1e-11);
    }
  }
}

// Triaxial compression beside 0.5: q = sqrt(3 (A0 + A1 p)), p = 0.5 + q/3.
TEST(Soil, TriaxialCompression) {
  const auto law = soil("1.0,0.5,0.0");
  DrivenPoint point(law);
  press(point, 0.0125, 1);  // 0.5
  for (int n = 0; n < 400; ++n) {
    const auto stress = point.stress;
    const auto history = point.history;
    Real low = -2e-3, high = 2e-3;
    for (int k = 0; k < 60; ++k) {
      const Real x = 0.5 * (low + high);
      point.stress = stress, point.history = history;
      point.strain({-1e-3, x, x, 0, 0, 0});
      (point.stress[1] > -0.5 ? high : low) = x;
    }
  }
  // q^2 = 3 (1.25 + q/6)
  const Real q = 0.25 + std::sqrt(0.0625 + 3.75);
  EXPECT_NEAR(point.stress[1] - point.stress[0], q, 1e-6);
}

TEST(Soil, TensionEndsAtTheCutOffAndComesBackOrNot) {
  for (const bool fails : {false, true}) {
    DrivenPoint point(soil("1.0,0.5,0.0", "", fails ? "MAT_SOIL_AND_FOAM_FAILURE" : "MAT_SOIL_AND_FOAM"));
    press(point, -1e-4, 10);  // to 0.11 of tension
    EXPECT_NEAR(pressure(point), -0.11, 1e-12);
    press(point, -1e-3, 10);
    EXPECT_NEAR(pressure(point), fails ? 0 : -0.2, 1e-12);
    press(point, 1e-3, 10), press(point, 1e-4, 5);  // closed but for a part
    EXPECT_NEAR(pressure(point), fails ? 0 : -0.055, 1e-12);
    press(point, 1e-4, 5), press(point, 1e-3, 20);
    EXPECT_NEAR(pressure(point), table(0.02), 1e-11);
  }
}

TEST(Soil, AStrengthThatWouldGrowInTensionIsHeldAtItsLeast) {
  // 0.04 + 0.4 p + p^2 is 0 at p = -0.2, and would be 0.04 again at -0.4
  DrivenPoint point(law_from_cards("MAT_SOIL_AND_FOAM", "1,2e-9,15.0,110.0,0.04,0.4,1.0,-0.4\n\n" + points));
  press(point, -0.3 / 110, 1);
  point.strain({0, 0, 0, 0.1, 0, 0});
  EXPECT_NEAR(pressure(point), -0.3, 1e-12);
  EXPECT_NEAR(J2(point), 0, 1e-12);
}

TEST(Soil, CurvesOfEitherSignAreTheSameTable) {
  const std::string card = "1,2e-9,15.0,110.0,1.0,0.5,0.0,-0.2\n,,9\n\n\n\n\n*DEFINE_CURVE\n9\n";
  for (const char* curve :
       {"0.0,0.0\n0.05,2.0\n0.1,3.0\n0.3,20.0\n", "-0.3,20.0\n-0.1,3.0\n-0.05,2.0\n0.0,0.0\n"}) {
    DrivenPoint point(law_from_cards("MAT_SOIL_AND_FOAM", card + curve));
    for (const Real to : {0.03, 0.09, 0.25}) {
      press(point, to + point.of("logarithmic_volume"), 1);
      EXPECT_NEAR(pressure(point), table(to), 1e-11) << curve;
    }
  }
}

}  // namespace soil_test
