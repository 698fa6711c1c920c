// Points of *MAT_034: tension fields against principal stresses and a search over directions, fibres that
// turn with the sheet, curves of loading and unloading.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "law_from_cards.hpp"
#include "laws/strength/tension_field.hpp"
#include "ply_point.hpp"

using namespace courant;
using test::OnePoint;

namespace {

const std::string fibre_curves =
    "*DEFINE_CURVE\n5\n0.0,0.0\n0.1,1.0\n0.2,4.0\n*DEFINE_CURVE\n6\n0.0,0.0\n0.05,0.5\n0.06,2.5\n0.07,6.5\n";

OnePoint fibres(const std::string& curves, int cse = 1) {
  return OnePoint(test::law_from_cards(
      "MAT_FABRIC",
      fmt::format("1,1.0,20.0,10.0,,0.0\n3.0,,,{}\n0.0,,,,,14\n\n\n{}\n", cse, curves) + fibre_curves));
}

Real norm2(const PlaneStress& s) {
  return s.a * s.a + s.b * s.b + 2 * s.ab * s.ab;
}

}  // namespace

// Of isotropic sheets tension is along the largest strain.
TEST(TensionField, OfIsotropicSheetsIsUniaxialAlongTheLargestStrain) {
  const Real E = 3, nu = 0.3;
  const TensionField sheet(SheetStiffness(E, E, nu), E / (2 * (1 + nu)));
  for (const Real turn : {0.0, 0.4, 1.3, 2.9}) {
    const Real c = std::cos(turn), s = std::sin(turn);
    const auto at = [&](Real e1, Real e2) {
      return sheet.without_compression(c * c * e1 + s * s * e2, s * s * e1 + c * c * e2, c * s * (e1 - e2));
    };
    const PlaneStress wrinkled = at(0.02, -0.05), taut = at(0.02, 0.01), slack = at(-0.01, -0.02);
    EXPECT_NEAR(wrinkled.a, E * 0.02 * c * c, 1e-12);
    EXPECT_NEAR(wrinkled.b, E * 0.02 * s * s, 1e-12);
    EXPECT_NEAR(wrinkled.ab, E * 0.02 * c * s, 1e-12);
    EXPECT_NEAR(taut.a + taut.b, E / (1 - nu) * 0.03, 1e-12);
    EXPECT_EQ(norm2(slack), 0);
  }
}

// Of orthotropic ones: no compression, one tension, the strain along it that of Hooke's law, and the stress
// the slope of its energy, whose largest value over directions a fine search finds.
TEST(TensionField, OfOrthotropicSheetsStoresTheMostEnergyOfAllDirections) {
  const Real EA = 8, EB = 1, PRBA = 0.1, G = 0.4;
  const TensionField sheet(SheetStiffness(EA, EB, PRBA), G);
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> strain(-0.1, 0.1);
  int wrinkled = 0;
  for (int n = 0; n < 100; ++n) {
    const Real a = strain(random), b = strain(random), ab = strain(random);
    const PlaneStress s = sheet.without_compression(a, b, ab);
    const Real det = s.a * s.b - s.ab * s.ab, trace = s.a + s.b;
    ASSERT_GE(trace, 0);
    EXPECT_GE(det, -1e-12);
    if (det > 1e-10 || trace == 0) continue;
    ++wrinkled;
    Real most = 0;
    for (int k = 0; k < 10000; ++k) {
      const Real c = std::cos(pi * k / 10000), d = std::sin(pi * k / 10000);
      const Real e = c * c * a + d * d * b + 2 * c * d * ab;
      const Real S = std::pow(c, 4) / EA + std::pow(d, 4) / EB + (1 / G - 2 * PRBA / EB) * c * c * d * d;
      if (e > 0) most = std::max(most, e * e / S);
    }
    const Real work = s.a * a + s.b * b + 2 * s.ab * ab;  // t e
    EXPECT_NEAR(work, most, 1e-5 * most);
    EXPECT_GE(work, most * (1 - 1e-12));
  }
  EXPECT_GT(wrinkled, 25);
}

TEST(WovenFabric, LoadsAlongItsCurveAndUnloadsAlongTheShiftedOne) {
  OnePoint p = fibres("5,0,0,6");
  Real sum = 0;
  const auto to = [&](Real e, int steps = 500) {
    p.strain(e - sum, 0, 0, steps), sum = e;
    return p.stress[0];
  };
  EXPECT_NEAR(to(0.05), 0.5, 1e-5);
  EXPECT_NEAR(to(0.15), 2.5, 1e-5);
  // 2.5 of unloading is at 0.06: shifted by 0.09
  EXPECT_NEAR(to(0.145), 1.5, 1e-5);
  EXPECT_NEAR(to(0.12), 0.3, 1e-5);
  EXPECT_EQ(to(0.08), 0);
  EXPECT_NEAR(to(0.145), 1.5, 1e-5);  // back along it
  EXPECT_NEAR(to(0.17), 3.1, 1e-5);
  EXPECT_EQ(p.stress[1], 0);
}

TEST(WovenFabric, StretchesACurveOfUnloadingWhoseNumberIsNegative) {
  OnePoint p = fibres("5,0,0,-6");
  p.strain(0.15, 0, 0, 500);
  p.strain(-0.0125, 0, 0, 100);  // 0.1375 of 0.15 is 0.055 of 0.06
  EXPECT_NEAR(p.stress[0], 1.5, 1e-4);
  p.strain(-0.075, 0, 0, 500);  // 0.0625: 0.025
  EXPECT_NEAR(p.stress[0], 0.25, 1e-5);
}

// From a little above 0.005, where the stress is 0.05, back along a curve a hundred times as long: its slope
// of 10 there is almost 1000, which bounds the step.
TEST(WovenFabric, AStretchedCurveIsAsSteepAsItIsStretched) {
  const auto law = test::law_from_cards(
      "MAT_FABRIC",
      "1,1.0,10.0,10.0,,0.0\n3.0,,,1\n0.0,,,,,14\n\n\n5,0,0,-6\n*DEFINE_CURVE\n5\n0.0,0.0\n0.1,1.0\n"
      "*DEFINE_CURVE\n6\n0.0,0.0\n0.5,0.05\n0.6,1.05\n");
  EXPECT_GT(law->plane_modulus(), 500);
  EXPECT_LT(law->plane_modulus(), 1000);
}

TEST(WovenFabric, BearsCompressionUnlessToldNotTo) {
  OnePoint bears = fibres("5", 0), gives = fibres("5", 1);
  bears.strain(-0.1, 0, 0, 200), gives.strain(-0.1, 0, 0, 200);
  EXPECT_NEAR(bears.stress[0], -20 * 0.1, 1e-4);
  EXPECT_EQ(gives.stress[0], 0);
}

// A picture frame: fibres keep their lengths while the angle between them falls by gamma.
TEST(WovenFabric, FibresTurnWithoutTensionInAPictureFrame) {
  OnePoint p = fibres("0,0,5");
  const Real gamma = 0.15;
  const int steps = 400;
  for (int k = 1; k <= steps; ++k) {
    // F = (cos g/2, sin g/2; sin g/2, cos g/2): D = F' F^-1
    const Real g = gamma * (k - 0.5) / steps, rate = gamma / steps / std::cos(g);
    const Real along = -0.5 * rate * std::sin(g);
    p.strain(along, along, 0.5 * rate);
  }
  const Real tau = 2.5, c = std::cos(gamma / 2), s = std::sin(gamma / 2);
  EXPECT_NEAR(p.stress[0], tau * 2 * c * s, 1e-4);
  EXPECT_NEAR(p.stress[1], tau * 2 * c * s, 1e-4);
  EXPECT_NEAR(p.stress[3], tau, 1e-4);
}
