// Plies of *MAT_054 and 055: each mode fails at its strength, and takes the right moduli away.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include <cmath>
#include <vector>

#include "law_from_cards.hpp"
#include "laws/strength/material_axes.hpp"
#include "ply_point.hpp"

using namespace courant;

namespace {

constexpr Real EA = 100, EB = 10, GAB = 5, XC = 0.8, XT = 1.5, YC = 0.3, YT = 0.1, SC = 0.2;

std::shared_ptr<StrengthLaw> ply(const std::string& fifth = "", const std::string& more = "",
                                 const std::string& dfail = "", Real prba = 0) {
  return test::law_from_cards(
      "MAT_ENHANCED_COMPOSITE_DAMAGE",
      fmt::format("1,1.0,{},{},0.0,{}\n{},2.0,3.0\n\n0.0,0.0,0.0,0.0,0.0,0.0,{}\n{}\n{},{},{},{},{},{}\n", EA,
                  EB, prba, GAB, dfail, fifth, XC, XT, YC, YT, SC, more));
}

using test::OnePoint;

}  // namespace

TEST(CompositeDamage, FibresInTensionTakeThePlyAway) {
  for (const int steps : {1, 7}) {
    OnePoint p(ply());
    p.strain(0.99 * XT / EA, 0, 0, steps);
    EXPECT_NEAR(p.stress[0], 0.99 * XT, 1e-12);
    p.strain(0.02 * XT / EA, 0, 0);
    EXPECT_EQ(p.stress[0], 0);
    EXPECT_EQ(p.of("failed_ply"), 1);
    p.strain(-1, 1, 1);
    for (const int k : {0, 1, 3}) EXPECT_EQ(p.stress[k], 0);
  }
}

// With DFAILT the ply bears its strength until that strain; b and shear bear no more than at the failure.
TEST(CompositeDamage, FibresInTensionBearTheirStrengthUntilDfailt) {
  for (const int steps : {1, 9}) {
    OnePoint p(ply("0.0,0.0,1.0,0.0,2.0,0.05"));
    p.strain(0, 0.5 * YT / EB, 0);
    p.strain(0.04, 0, 0, steps);
    EXPECT_NEAR(p.stress[0], XT, 1e-12);
    p.strain(0, 1, 1);
    EXPECT_NEAR(p.stress[1], 0.5 * YT, 1e-12);
    EXPECT_EQ(p.stress[3], 0);
    p.strain(-0.1 * XT / EA, 0, 0);  // unloads elastically
    EXPECT_NEAR(p.stress[0], 0.9 * XT, 1e-12);
    EXPECT_EQ(p.of("failed_ply"), 0);
    p.strain(0.02, 0, 0);
    EXPECT_EQ(p.of("failed_ply"), 1);
    EXPECT_EQ(p.stress[0], 0);
  }
}

TEST(CompositeDamage, FibresInCompressionLoseTheirModulusAlone) {
  OnePoint p(ply("", "", "", 0.02));
  const Real f = 1 / (1 - 0.02 * 0.02 * EA / EB);
  p.strain(-0.999 * XC / (f * EA), 0, 0);
  EXPECT_NEAR(p.stress[0], -0.999 * XC, 1e-12);
  EXPECT_NEAR(p.stress[1], -0.999 * XC * 0.02, 1e-12);
  p.strain(-0.1, 0, 0);
  EXPECT_NEAR(p.stress[0], -XC, 1e-12);
  const Real b = p.stress[1];
  p.strain(-0.1, 0.2 * YT / EB, 0.1 * SC / GAB);
  EXPECT_NEAR(p.stress[0], -XC, 1e-12);
  EXPECT_NEAR(p.stress[1], b + 0.2 * YT, 1e-12);  // without Poisson's ratio
  EXPECT_NEAR(p.stress[3], 0.2 * SC, 1e-12);
  EXPECT_EQ(p.of("failed_modes"), 2);
}

// (b/YT)^2 + (tau/SC)^2 = 1 on a ray of stress, then neither b nor shear bear more, and a goes on.
TEST(CompositeDamage, MatrixInTension) {
  for (const Real angle : {0.0, 0.4, 1.1, pi / 2}) {
    OnePoint p(ply());
    const Real b = YT * std::cos(angle), tau = SC * std::sin(angle);
    p.strain(0, 0.999 * b / EB, 0.999 * tau / (2 * GAB));
    EXPECT_NEAR(p.stress[1], 0.999 * b, 1e-12);
    EXPECT_EQ(p.of("failed_modes"), 0);
    p.strain(0, 2 * b / EB, 2 * tau / (2 * GAB), 3);
    EXPECT_NEAR(p.stress[1], b, 1e-12) << angle;
    EXPECT_NEAR(p.stress[3], tau, 1e-12) << angle;
    EXPECT_EQ(p.of("failed_modes"), 4);
    p.strain(0.5 * XT / EA, 0, 0);
    EXPECT_NEAR(p.stress[0], 0.5 * XT, 1e-12);
  }
}

// At YC in compression alone; with shear on the curve of the criterion.
TEST(CompositeDamage, MatrixInCompression) {
  const Real q = YC / (2 * SC);
  for (const Real share : {0.0, 0.3, 0.8}) {
    OnePoint p(ply());
    p.strain(0, -share * 5 / EB, -5.0 * (1 - share) / (2 * GAB));
    if (share == 0) {
      EXPECT_NEAR(p.stress[3], -SC, 1e-12);
      continue;
    }
    const Real b = p.stress[1] / YC, tau = p.stress[3] / SC;
    EXPECT_NEAR(q * q * b * b + (q * q - 1) * b + tau * tau, 1, 1e-10) << share;
    EXPECT_EQ(p.of("failed_modes"), 8);
  }
  OnePoint p(ply());
  p.strain(0, -0.999 * YC / EB, 0);
  EXPECT_EQ(p.of("failed_modes"), 0);
  p.strain(0, -1, 0);
  EXPECT_NEAR(p.stress[1], -YC, 1e-12);
  p.strain(-1, 0, 0);  // XC = 2 YC behind it
  EXPECT_NEAR(p.stress[0], -2 * YC, 1e-12);
}

TEST(CompositeDamage, MatrixByTsaiAndWu) {
  for (const auto& [b, expected] : {std::pair(1.0, YT), {-1.0, -YC}}) {
    OnePoint p(ply("", "55.0"));
    p.strain(0, b, 0, 3);
    EXPECT_NEAR(p.stress[1], expected, 1e-12);
  }
  OnePoint p(ply("", "55.0"));
  p.strain(0, -2.0 / EB, 1.0 / (2 * GAB));
  const Real b = p.stress[1], tau = p.stress[3];
  EXPECT_NEAR(b * b / (YC * YT) + tau * tau / (SC * SC) + (YC - YT) * b / (YC * YT), 1, 1e-10);
}

TEST(CompositeDamage, ShearWeakensFibresByBeta) {
  OnePoint p(ply("0.0,0.0,1.0,0.0,2.0,1.0", "54.0,0.5"));
  p.strain(3 * 0.6 / EA, 0, 3 * 0.02 / (2 * GAB));
  const Real a = p.stress[0] / XT, tau = p.stress[3] / SC;
  EXPECT_NEAR(a * a + 0.5 * tau * tau, 1, 1e-12);
}

// gamma = tau/GAB + ALPH tau^3
TEST(CompositeDamage, ShearThatSoftens) {
  OnePoint p(ply("0.0,200.0"));
  const Real tau = 0.15, gamma = tau / GAB + 200 * tau * tau * tau;
  p.strain(0, 0, gamma / 2, 4);
  EXPECT_NEAR(p.stress[3], tau, 1e-12);
  p.strain(0, 0, -gamma);
  EXPECT_NEAR(p.stress[3], -tau, 1e-12);
}

TEST(CompositeDamage, StrainsThatTakeAPlyAway) {
  struct Case {
    std::string fifth, dfail;
    std::array<Real, 3> strain;
  };
  const Case cases[] = {{"0.0,0.0,1.0,0.0,2.0,0.05,-0.03", "", {-0.031, 0, 0}},
                        {"0.0,0.0,1.0,0.0,2.0,0.05", "0.02", {0, -0.021, 0}},
                        {"0.0,0.0,1.0,0.0,2.0,0.05", "0.0,0.04", {0, 0, 0.041}},
                        {"0.0,0.0,1.0,0.0,2.0,0.0,0.0,0.01", "", {0, 0.00867, 0}}};
  for (const Case& c : cases) {
    OnePoint p(ply(c.fifth, "", c.dfail));
    const auto [a, b, ab] = c.strain;
    p.strain(0.95 * a, 0.95 * b, 0.95 * ab);
    EXPECT_EQ(p.of("failed_ply"), 0) << c.fifth;
    p.strain(0.05 * a, 0.05 * b, 0.05 * ab);
    EXPECT_EQ(p.of("failed_ply"), 1) << c.fifth;
  }
}

TEST(CompositeDamage, WhatIsLeftOfTheStrength) {
  OnePoint p(ply("", "54.0\n\n0.5,0.25,0.2,0.1,0.4"));
  p.strain(0, 0, 10);
  EXPECT_NEAR(p.stress[3], 0.4 * SC, 1e-12);
  OnePoint a(ply("", "54.0\n\n0.5,0.25,0.2,0.1,0.4"));
  a.strain(-1, 0, 0);
  EXPECT_NEAR(a.stress[0], -0.25 * XC, 1e-12);
  OnePoint b(ply("", "54.0\n\n0.5,0.25,0.2,0.1,0.4"));
  b.strain(0, 1, 0);
  EXPECT_NEAR(b.stress[1], 0.2 * YT, 1e-12);
}

// Loading, unloading and turning round never return more than went in.
TEST(CompositeDamage, NoPathGivesEnergyAway) {
  OnePoint p(ply("0.0,50.0,1.0,0.0,2.0,1.0", "54.0,1.0", "", 0.02));
  Real work = 0, least = 0;
  for (int k = 0; k < 20000; ++k) {
    const Real t = 1e-3 * k,
               d[3] = {1e-4 * std::cos(1.3 * t), 3e-4 * std::cos(2.1 * t + 1), 3e-4 * std::sin(1.7 * t)};
    const Real before[3] = {p.stress[0], p.stress[1], p.stress[3]};
    p.strain(d[0], d[1], d[2]);
    work += 0.5 * ((before[0] + p.stress[0]) * d[0] + (before[1] + p.stress[1]) * d[1]) +
            (before[2] + p.stress[3]) * d[2];
    least = std::min(least, work);
  }
  EXPECT_GE(least, -1e-4);
  EXPECT_GT(p.of("failed_modes"), 0);
}

TEST(MaterialAxes, DirectionsInAShell) {
  const Vec n = Vec(0, 0, 1), side = Vec(1, 0, 0);
  Vec a;
  MaterialAxes axes;
  axes.beta = 90;
  EXPECT_TRUE(direction_in_shell(axes, n, side, a));
  EXPECT_LT((a - Vec(0, 1, 0)).norm(), 1e-12);
  axes = {MaterialAxes::Rule::vector, Vec(0, 2, 5), 0};
  EXPECT_TRUE(direction_in_shell(axes, n, side, a));
  EXPECT_LT((a - Vec(0, 1, 0)).norm(), 1e-12);
  axes = {MaterialAxes::Rule::across, Vec(0, 2, 5), 0};
  EXPECT_TRUE(direction_in_shell(axes, n, side, a));
  EXPECT_LT((a - Vec(1, 0, 0)).norm(), 1e-12);
  axes = {MaterialAxes::Rule::vector, Vec(0, 0, 5), 0};
  EXPECT_FALSE(direction_in_shell(axes, n, side, a));
}

namespace {

/// With SOFT, TFAIL and curves over the rate on the last cards.
OnePoint ply_with(Real tfail, Real soft, Real softg, const std::string& curves, const std::string& more) {
  return OnePoint(
      test::law_from_cards("MAT_ENHANCED_COMPOSITE_DAMAGE",
                           fmt::format("1,1.0,{},{},0.0,0.0\n{},2.0,3.0\n\n\n{},0.0,{}\n{},{},{},{},{}\n\n1."
                                       "0,1.0,1.0,1.0,1.0,0.0,{}\n{}\n",
                                       EA, EB, GAB, tfail, soft, XC, XT, YC, YT, SC, softg, curves) +
                               more));
}

}  // namespace

TEST(CompositeDamage, IsWeakerBesideDeletedElementsWhereTheyGoByTheirStep) {
  for (const bool acts : {true, false}) {
    OnePoint p = ply_with(acts ? 1e-6 : 0, 0.6, 0.5, "", "");
    p.strain(0, 0.5 * YT / EB, 0);
    p.at(beside_deleted) = 1;
    p.strain(0, 0.5 * YT / EB, 0, 1, 0.001, 0.002);
    EXPECT_NEAR(p.stress[1], (acts ? 0.6 : 1) * YT, 1e-12) << acts;
    EXPECT_NEAR(p.stress[4], (acts ? 0.5 : 1) * 2 * 2 * 0.001, 1e-15) << acts;
    EXPECT_NEAR(p.stress[5], (acts ? 0.5 : 1) * 2 * 3 * 0.002, 1e-15) << acts;
  }
}

TEST(CompositeDamage, StepsBelowTfailTakeElementsAway) {
  EXPECT_EQ(ply_with(1e-6, 1, 1, "", "").law->least_step().step, 1e-6);
  EXPECT_EQ(ply_with(1e-6, 1, 1, "", "").law->least_step().ratio, 0);
  EXPECT_EQ(ply_with(0.4, 1, 1, "", "").law->least_step().step, 0);
  EXPECT_EQ(ply_with(0.4, 1, 1, "", "").law->least_step().ratio, 0.4);
  EXPECT_EQ(ply_with(-1, 1, 1, "", "").law->least_step().step, 0);
}

// Strength YT 0.1 at rest and 0.3 at a rate of 0.001: at a rate r kept long enough 0.1 + 200 r. The rate is
// that of the effective strain, sqrt(4/3) times the one along b.
TEST(CompositeDamage, StrengthsFollowTheRate) {
  const std::string curve = "*DEFINE_CURVE\n5\n0.0,0.1\n0.001,0.3\n";
  for (const Real rate : {0.00002, 0.00005}) {  // along b, by a step of 1
    OnePoint p = ply_with(0, 1, 1, "0,0,0,5", curve);
    p.strain(0, 1000 * rate, 0, 1000);
    EXPECT_NEAR(p.stress[1], 0.1 + 200 * std::sqrt(4.0 / 3) * rate, 1e-9) << rate;
  }
  // DT: the mean grows as 1 - exp(-t/DT)
  OnePoint p = ply_with(0, 1, 1, "0,0,0,5,0,50.0", curve);
  p.strain(0, 0.05, 0, 50);
  EXPECT_NEAR(p.of("ply_rate"), std::sqrt(4.0 / 3) * 0.001 * (1 - std::exp(-1.0)), 1e-12);
}
