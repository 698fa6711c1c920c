#include "sph/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace courant;

namespace {

/// Integral of W over its support by the midpoint rule in the radius.
template <int Dim>
Real integral(Real h) {
  const int n = 20000;
  const Real dr = 2 * h / n;
  Real total = 0;
  for (int k = 0; k < n; ++k) {
    const Real r = (k + 0.5) * dr;
    const Real shell = Dim == 1 ? 2 : Dim == 2 ? 2 * pi * r : 4 * pi * r * r;
    total += CubicSpline<Dim>::C * CubicSpline<Dim>::shape(r / h) / power<Dim>(h) * shell * dr;
  }
  return total;
}

}  // namespace

TEST(CubicSpline, IntegratesToOneInEveryDimension) {
  EXPECT_NEAR(integral<1>(0.3), 1, 1e-8);
  EXPECT_NEAR(integral<2>(0.3), 1, 1e-8);
  EXPECT_NEAR(integral<3>(0.3), 1, 1e-8);
}

TEST(CubicSpline, SlopeIsTheDerivativeOfTheShape) {
  const Real d = 1e-6;
  for (const Real R : {0.1, 0.5, 0.999, 1.001, 1.7, 1.999, 2.5}) {
    const Real differences = (CubicSpline<2>::shape(R + d) - CubicSpline<2>::shape(R - d)) / (2 * d);
    EXPECT_NEAR(CubicSpline<2>::slope(R), differences, 1e-8) << R;
  }
}

TEST(CubicSpline, HasTheShapeOfEquation10) {
  EXPECT_DOUBLE_EQ(CubicSpline<3>::shape(0), 1);
  EXPECT_DOUBLE_EQ(CubicSpline<3>::shape(1), 0.25);
  EXPECT_DOUBLE_EQ(CubicSpline<3>::shape(0.5), 1 - 1.5 * 0.25 + 0.75 * 0.125);
  EXPECT_DOUBLE_EQ(CubicSpline<3>::shape(2), 0);
  EXPECT_DOUBLE_EQ(CubicSpline<3>::slope(3), 0);
}
