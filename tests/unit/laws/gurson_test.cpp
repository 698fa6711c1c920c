// *MAT_GURSON against the equations of Gurson, Tvergaard and Needleman, step by step.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "driven_point.hpp"
#include "law_from_cards.hpp"

namespace gurson_test {

using namespace courant;
using test::DrivenPoint;
using test::law_from_cards;

namespace {

constexpr Real E = 2e5, nu = 0.3, SIGY = 400, N = 8, q1 = 1.5, q2 = 1.1, fc = 0.05, f0 = 0.002, EN = 0.1,
               SN = 0.05, FN = 0.04, FF = 0.2;
std::string cards(const std::string& tail = "\n\n\n", Real first = f0, Real ff = FF, Real mean = EN) {
  return fmt::format("1,7.8e-9,{},{},{},{},{},{}\n{},{},{},{},{},0.0,1,{}\n{}", E, nu, SIGY, N, q1, q2, fc,
                     first, mean, SN, FN, ff, tail);
}
Real matrix(Real e) {
  return SIGY * std::pow(1 + E * e / SIGY, 1 / N);
}
Real joined(Real f) {
  return q1 * (f > fc ? fc + (1 / q1 - fc) / (FF - fc) * (f - fc) : f);
}
void set(DrivenPoint& p, const std::string& name, Real value) {
  for (std::size_t k = 0; k < p.names.size(); ++k)
    if (p.names[k] == name) p.history[p.first[k]] = value;
}
Real mean_of(const DrivenPoint& p) {
  return (p.stress[0] + p.stress[1] + p.stress[2]) / 3;
}

}  // namespace

// A bar, in space and in the plane: on the surface with the voids of the start of the step; the plastic
// strains of its axis and its sides along the normal; its work that of the matrix; voids grow by volume and
// nucleation.
TEST(Gurson, BarsObeyTheEquations) {
  for (const bool plane : {false, true}) {
    DrivenPoint bar(law_from_cards("MAT_GURSON", cards()), plane);
    Real e = 0, f = f0, stress = 0;
    for (int k = 0; k < 500; ++k) {
      auto step = bar.strain_with_free({5e-4, -2e-4, -2e-4, 0, 0, 0},
                                       plane ? std::vector<std::size_t>{1} : std::vector<std::size_t>{1, 2});
      if (plane) step[2] = bar.rate_zz;
      const Real now = bar.of("plastic_strain"), de = now - e, s = bar.stress[0], b = 1.5 * q2 / matrix(now);
      const Real along = step[0] - (s - stress) / E, y = step[1] + nu * (s - stress) / E,
                 z = step[2] + nu * (s - stress) / E;
      if (de > 0) {
        const Real F = joined(f), Y = matrix(now);
        EXPECT_NEAR(s * s / (Y * Y) + 2 * F * std::cosh(b * s / 3) - 1 - F * F, 0, 1e-8) << k;
        EXPECT_NEAR((1 - f) * Y * de, s * along, 1e-6 * Y * de) << k;
        const Real volume = along + y + z, shear = 2.0 / 3 * (along - 0.5 * (y + z));
        EXPECT_NEAR(volume * 2 * s, shear * 3 * F * q2 * Y * std::sinh(b * s / 3), 1e-5 * shear * Y) << k;
        const Real x = (e + 0.5 * de - EN) / SN;
        f += (1 - f) * volume + FN / (SN * std::sqrt(2 * pi)) * std::exp(-0.5 * x * x) * de;
      }
      if (e > 0) {
        EXPECT_NEAR(bar.of("failure_ratio"), f / FF, 1e-4) << k;
      }
      EXPECT_NEAR(bar.of("void_growth"), f - f0, 1e-7) << k;
      e = now, stress = s;
    }
    EXPECT_GT(f, 0.03);
  }
}

// Blown up it bears 2 Y/(3 Q2) arcosh((1 + F^2)/(2 F)), until voids that join leave nothing.
TEST(Gurson, BurstsUnderTension) {
  DrivenPoint point(law_from_cards("MAT_GURSON", cards("\n\n\n", 0.01)));
  Real f = 0.01, last = 0;
  int steps = 0;
  while (point.of("failure_ratio") < 1 && ++steps < 4000) {
    point.strain({2e-4, 2e-4, 2e-4, 0, 0, 0});
    const Real e = point.of("plastic_strain"), F = joined(f);
    if (e > last && F < 1) {
      EXPECT_NEAR(mean_of(point), 2 * matrix(e) / (3 * q2) * std::acosh((1 + F * F) / (2 * F)), 1e-6 * SIGY)
          << steps;
    }
    last = e, f = 0.01 + point.of("void_growth");
  }
  EXPECT_LT(steps, 4000);
  EXPECT_GE(f, FF);
  for (int k = 0; k < 3; ++k) point.strain({2e-4, 2e-4, 2e-4, 0, 0, 0});
  EXPECT_NEAR(mean_of(point), 0, 1e-9);
}

// Under pressure voids close down to F0, to nothing, or stay.
TEST(Gurson, VoidsCloseUnderPressure) {
  for (const int type : {0, 1, 2}) {
    DrivenPoint point(
        law_from_cards("MAT_GURSON", cards(fmt::format("\n\n\n0,0,1.0,0,0,0,{}\n", type), 0.02, FF, 5)));
    for (int k = 0; k < 40; ++k) point.strain({2e-4, 2e-4, 2e-4, 0, 0, 0});
    const Real grown = point.of("void_growth");
    EXPECT_GT(grown, 1e-3);
    for (int k = 0; k < 2000; ++k) point.strain({-1e-4, -1e-4, -1e-4, 0, 0, 0});
    if (type == 1) {
      EXPECT_GE(point.of("void_growth"), grown);
    } else {
      EXPECT_NEAR(point.of("void_growth"), type == 0 ? 0 : -0.02, type == 0 ? 1e-12 : 2e-3);
    }
  }
}

// Voids at failure over the element's size by L and FF, and by LCLF; F0 by LCF0.
TEST(Gurson, KnowsTheSizeOfItsElement) {
  const std::string curves = "*DEFINE_CURVE\n3\n1.0,0.3\n5.0,0.1\n*DEFINE_CURVE\n4\n1.0,0.001\n5.0,0.003\n";
  const auto points = law_from_cards("MAT_GURSON", cards("\n\n1.0,5.0,,,0.3,0.1\n\n", f0, 0));
  const auto curve = law_from_cards("MAT_GURSON", cards("\n\n\n0,3,1.0,4\n" + curves, 0, 0));
  for (const auto& [size, ff, first] :
       {std::array{0.5, 0.3, 0.001}, {2.0, 0.25, 0.0015}, {9.0, 0.1, 0.003}}) {
    DrivenPoint a(points), b(curve);
    set(a, "element_size", size), set(b, "element_size", size);
    for (int k = 0; k < 60; ++k) a.strain({2e-4, 2e-4, 2e-4, 0, 0, 0}), b.strain({2e-4, 2e-4, 2e-4, 0, 0, 0});
    EXPECT_NEAR(a.of("failure_ratio"), (f0 + a.of("void_growth")) / ff, 1e-12);
    EXPECT_NEAR(b.of("failure_ratio"), (first + b.of("void_growth")) / ff, 1e-12);
    EXPECT_GT(a.of("failure_ratio"), 0);
  }
}

}  // namespace gurson_test
