// *MAT_BILKHU/DUBOIS_FOAM against closed forms: the ellipse, its curves, tension, rates.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "driven_point.hpp"
#include "law_from_cards.hpp"

namespace bilkhu_foam_test {

using namespace courant;
using test::DrivenPoint;
using test::law_from_cards;

namespace {

const std::string curves =
    "*DEFINE_CURVE\n5\n0.0,0.4\n0.5,0.9\n1.0,4.0\n*DEFINE_CURVE\n6\n0.0,0.5\n0.4,0.7\n1.0,3.0\n";
Real even(Real g) {
  return g < 0.5 ? 0.4 + g : 0.9 + 6.2 * (g - 0.5);
}
Real uniaxial(Real g) {
  return g < 0.4 ? 0.5 + 0.5 * g : 0.7 + 2.3 / 0.6 * (g - 0.4);
}
/// `card_1`: PC, VPC; `card_2`: TSC, VTSC, LCRATE, PR, KCON, ISFLG, NCYCLE.
std::shared_ptr<StrengthLaw> foam(const std::string& card_1, const std::string& card_2,
                                  const std::string& more = "") {
  return law_from_cards("MAT_BILKHU/DUBOIS_FOAM",
                        "1,1e-10,20.0,5,6,0.0," + card_1 + "\n" + card_2 + "\n" + curves + more);
}
Real pressure(const DrivenPoint& p) {
  return -(p.stress[0] + p.stress[1] + p.stress[2]) / 3;
}
Real q_of(const DrivenPoint& p) {
  Real sum = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const Real s = p.stress[k] + (k < 3 ? pressure(p) : 0);
    sum += (k < 3 ? 1.5 : 3) * s * s;
  }
  return std::sqrt(sum);
}
/// 1 on the ellipse through (-cut, 0), (y/3, y), (py, 0).
Real on_ellipse(Real p, Real q, Real py, Real y, Real cut) {
  const Real centre = (py - cut) / 2, half = (py + cut) / 2;
  const Real height_2 = y * y / (1 - std::pow((y / 3 - centre) / half, 2));
  return std::pow((p - centre) / half, 2) + q * q / height_2;
}

}  // namespace

TEST(BilkhuFoam, BarsAndPressureAreOnTheirCurves) {
  for (const Real nu : {0.0, 0.2}) {
    const auto law = foam("0.05", fmt::format("0.02,,,{}", nu));
    DrivenPoint bar(law), box(law);
    Real along = 0, across = 0;
    for (int n = 0; n < 400; ++n) {
      const auto by = bar.strain_with_free({-2e-3, 0, 0, 0, 0, 0}, {1, 2});
      along -= 2e-3, across += by[1];
      box.strain({-5e-4, -5e-4, -5e-4, 0, 0, 0});
      if (n < 50) continue;
      const Real g = -bar.of("logarithmic_volume"), h = -box.of("logarithmic_volume");
      EXPECT_NEAR(bar.stress[0], -uniaxial(g), 1e-9) << nu;
      EXPECT_NEAR(pressure(box), even(h), 1e-12) << nu;
      EXPECT_NEAR(q_of(box), 0, 1e-12);
    }
    // Poisson's ratio is that of PR in flow, too
    EXPECT_NEAR(across, -nu * along, 1e-9 + 1e-6 * nu);
  }
}

TEST(BilkhuFoam, PathsAreOnTheEllipse) {
  const auto law = foam("0.05", "10.0,,,0.25");
  const std::array<Real, 6> steps[] = {{-1e-3, 0, 0, 0, 0, 0},
                                       {-1e-3, -8e-4, 0, 3e-4, 0, 0},
                                       {-4e-4, 2e-4, 0, 1e-3, 0, 0},
                                       {1e-4, 0, 0, 0, 1e-3, 5e-4},
                                       {1e-3, 1e-3, 1e-3, 0, 0, 0}};
  for (const auto& step : steps) {
    DrivenPoint point(law);
    for (int n = 0; n < 600; ++n) {
      point.strain(step);
      if (n < 150) continue;
      const Real g = std::max(-point.of("logarithmic_volume"), 0.0);
      EXPECT_NEAR(on_ellipse(pressure(point), q_of(point), even(g), uniaxial(g), 0.05), 1, 1e-11);
    }
  }
}

TEST(BilkhuFoam, PressureCutOffIsATenthOfTheFirstYieldPressureOrAShare) {
  const std::array<Real, 6> apart = {1e-3, 1e-3, 1e-3, 0, 0, 0};
  for (const auto& [card, limit] : {std::pair{"0.0", 0.04}, {"0.07", 0.07}, {"0.07,0.5", 0.2}}) {
    DrivenPoint point(foam(card, "10.0"));
    for (int n = 0; n < 100; ++n) point.strain(apart);
    EXPECT_NEAR(pressure(point), -limit, 1e-12) << card;
  }
  // a share of the present yield pressure: pressed to -ln V = 0.3 first, 0.7 there
  DrivenPoint point(foam("0.0,0.5", "10.0"));
  point.strain({-0.1, -0.1, -0.1, 0, 0, 0});
  for (int n = 0; n < 200; ++n) point.strain({3e-4, 3e-4, 3e-4, 0, 0, 0});
  EXPECT_NEAR(pressure(point), -0.5 * even(-point.of("logarithmic_volume")), 1e-12);
}

TEST(BilkhuFoam, TensionIsLimited) {
  const std::array<Real, 6> longer = {1e-3, 0, 0, 0, 0, 0};
  for (const auto& [card, limit] : {std::pair{"", 0.0}, {"0.1", 0.1}, {"0.1,0.4", 0.2}}) {
    DrivenPoint point(foam("1.0", card));
    for (int n = 0; n < 300; ++n) point.strain(longer);
    EXPECT_NEAR(point.stress[0], limit, 1e-12) << card;
    // beside large shear, too: no principal stress is above it
    for (int n = 0; n < 100; ++n) {
      point.strain({0, 1e-3, 0, 2e-3, 0, 1e-3});
      Matrix s;
      const auto& t = point.stress;
      s << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
      EXPECT_LE(s.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff(), limit + 1e-12) << card;
    }
  }
}

// Pressed in two directions and torn in the third, with a high uniaxial yield stress: the cut raises the
// pressure beyond the ellipse, so that stress is scaled again.
TEST(BilkhuFoam, StaysOnTheEllipseWhereTensionIsCut) {
  DrivenPoint point(law_from_cards("MAT_BILKHU/DUBOIS_FOAM",
                                   "1,1e-10,20.0,5,6,0.0,0.05\n0.0\n*DEFINE_CURVE\n5\n0.0,0.4\n1.0,0.4\n"
                                   "*DEFINE_CURVE\n6\n0.0,0.9\n1.0,0.9\n"));
  point.strain({-0.03, -0.03, 0.003, 0, 0, 0});
  EXPECT_NEAR(point.stress[2], 0, 1e-15);
  EXPECT_NEAR(on_ellipse(pressure(point), q_of(point), 0.4, 0.9, 0.05), 1, 1e-11);
}

// LCRATE is 2 at a rate of -ln V of 10 and straight to 1 at rest; NCYCLE 9: each step has a weight of 1/5.
TEST(BilkhuFoam, RatesScaleBothCurves) {
  const std::string rates = "*DEFINE_CURVE\n7\n0.0,1.0\n10.0,2.0\n20.0,2.0\n";
  const auto law = foam("0.05", "0.0,,7,0.0,,,9.0", rates);
  DrivenPoint bar(law), box(law);
  bar.dt = 1e-4, box.dt = 5e-4;
  Real mean = 0;
  for (int n = 0; n < 300; ++n) {
    bar.strain({-1e-3, 0, 0, 0, 0, 0}), box.strain({-5e-4, -5e-4, -5e-4, 0, 0, 0});
    mean += 0.2 * (3 - mean);
    if (n < 200) continue;
    EXPECT_NEAR(bar.stress[0], -2 * uniaxial(-bar.of("logarithmic_volume")), 1e-9);
    EXPECT_NEAR(pressure(box), (1 + mean / 10) * even(-box.of("logarithmic_volume")), 1e-9);
  }
  EXPECT_NEAR(box.of("mean_crush_rate"), 3, 1e-9);
}

TEST(BilkhuFoam, SpringsBackElastically) {
  DrivenPoint bar(foam("0.05", "1.0,,,0.1"));
  for (int n = 0; n < 200; ++n) bar.strain_with_free({-2e-3, 0, 0, 0, 0, 0}, {1, 2});
  const Real top = bar.stress[0];
  bar.strain_with_free({1e-2, 0, 0, 0, 0, 0}, {1, 2});
  EXPECT_NEAR(bar.stress[0] - top, 20.0 * 1e-2, 1e-9);
}

}  // namespace bilkhu_foam_test
