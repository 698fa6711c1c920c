#include "sph/kernel/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "sph/kernel/kernel_choice.hpp"

using namespace courant;

namespace {

template <class Kernel>
class EveryKernel : public testing::Test {};

using Kernels =
    testing::Types<CubicSpline, QuinticSpline, QuadraticSpline, QuarticSpline, WendlandC2, WendlandC4>;
TYPED_TEST_SUITE(EveryKernel, Kernels);

/// Integral of W over its support by the midpoint rule in the radius.
template <class Kernel, int Dim>
Real integral(Real h) {
  const int n = 20000;
  const Real dr = Kernel::support * h / n;
  Real total = 0;
  for (int k = 0; k < n; ++k) {
    const Real r = (k + 0.5) * dr;
    const Real shell = Dim == 1 ? 2 : Dim == 2 ? 2 * pi * r : 4 * pi * r * r;
    total += Kernel::C(Dim) * Kernel::shape(r / h) / power<Dim>(h) * shell * dr;
  }
  return total;
}

/// Calls f(R) at positions within the support, none of them at a knot.
template <class Kernel, class F>
void at_places(F&& f) {
  for (int k = 0; k < 200; ++k) f((k + 0.37) / 200 * Kernel::support);
}

TYPED_TEST(EveryKernel, IntegratesToOneInEveryDimension) {
  EXPECT_NEAR((integral<TypeParam, 1>(0.3)), 1, 1e-8);
  EXPECT_NEAR((integral<TypeParam, 2>(0.3)), 1, 1e-8);
  EXPECT_NEAR((integral<TypeParam, 3>(0.3)), 1, 1e-8);
}

TYPED_TEST(EveryKernel, SlopeIsTheDerivativeOfTheShape) {
  const Real d = 1e-6;
  at_places<TypeParam>([&](Real R) {
    const Real differences = (TypeParam::shape(R + d) - TypeParam::shape(R - d)) / (2 * d);
    EXPECT_NEAR(TypeParam::slope(R), differences, 1e-8 * TypeParam::shape(0.0)) << R;
  });
}

TYPED_TEST(EveryKernel, IsTheSameWhereItIsKnownOnlyAtRunTime) {
  const AnyKernel any = AnyKernel::of<TypeParam>();
  for (int dim = 1; dim <= 3; ++dim) EXPECT_EQ(any.C(dim), TypeParam::C(dim));
  EXPECT_EQ(any.support, TypeParam::support);
  EXPECT_EQ(any.gradient_factor, TypeParam::gradient_factor);
  EXPECT_EQ(any.kink, TypeParam::kink);
  const auto compare = [&](Real R) {
    EXPECT_NEAR(any.shape(R), TypeParam::shape(R), 1e-14 * TypeParam::shape(0.0)) << R;
    const Real steepest = TypeParam::gradient(Real(TypeParam::steepest));
    EXPECT_NEAR(any.gradient(R), TypeParam::gradient(R), 1e-14 * std::abs(steepest) + 1e-13) << R;
    EXPECT_NEAR(any.half_curvature(R), TypeParam::half_curvature(R), 1e-13 * std::abs(steepest) + 1e-13) << R;
    Real gradient = 0, half_curvature = 0;
    any.slopes(R, gradient, half_curvature);
    EXPECT_NEAR(gradient, any.gradient(R), 1e-14 * std::abs(steepest) + 1e-13) << R;
    EXPECT_NEAR(half_curvature, any.half_curvature(R), 1e-13 * std::abs(steepest) + 1e-13) << R;
  };
  at_places<TypeParam>(compare);
  for (const Real R : {TypeParam::support, TypeParam::support + 0.5, 10.0}) {
    EXPECT_EQ(any.shape(R), 0);
    EXPECT_EQ(any.gradient(R), 0);
    EXPECT_EQ(any.half_curvature(R), 0);
  }
}

TYPED_TEST(EveryKernel, FallsToNothingAtItsSupport) {
  Real before = TypeParam::shape(0.0);
  at_places<TypeParam>([&](Real R) {
    EXPECT_LT(TypeParam::shape(R), before) << R;
    before = TypeParam::shape(R);
  });
  EXPECT_GT(TypeParam::shape(0.99 * TypeParam::support), 0);
  for (const Real R : {TypeParam::support, TypeParam::support + 0.5, 10.0}) {
    EXPECT_DOUBLE_EQ(TypeParam::shape(R), 0);
    EXPECT_DOUBLE_EQ(TypeParam::slope(R), 0);
    EXPECT_DOUBLE_EQ(TypeParam::gradient(R), 0);
    EXPECT_DOUBLE_EQ(TypeParam::half_curvature(R), 0);
  }
}

TYPED_TEST(EveryKernel, PairLoopsTakeTheSameSlope) {
  const Real d = 1e-6;
  at_places<TypeParam>([&](Real R) {
    EXPECT_NEAR(TypeParam::gradient_factor * TypeParam::gradient(R), TypeParam::slope(R),
                1e-14 * TypeParam::shape(0.0))
        << R;
    const Real differences = (TypeParam::gradient(R + d) - TypeParam::gradient(R - d)) / (2 * d);
    EXPECT_NEAR(2 * TypeParam::half_curvature(R), differences, 1e-7 * TypeParam::shape(0.0)) << R;
  });
}

TYPED_TEST(EveryKernel, IsSteepestWhereItSays) {
  const Real steepest = TypeParam::steepest;
  at_places<TypeParam>([&](Real R) { EXPECT_LE(-TypeParam::slope(R), -TypeParam::slope(steepest)) << R; });
  for (int k = 0; k <= 20; ++k) {
    const Real R = steepest * k / 20;
    EXPECT_NEAR(TypeParam::dip(R), TypeParam::shape(0.0) - TypeParam::shape(R),
                1e-14 * TypeParam::shape(0.0));
    EXPECT_NEAR(TypeParam::steepness(R), -TypeParam::slope(R), 1e-14 * TypeParam::shape(0.0));
  }
  EXPECT_EQ(TypeParam::kink, TypeParam::slope(0) != 0);
}

TEST(CubicSpline, HasTheShapeOfEquation10) {
  EXPECT_DOUBLE_EQ(CubicSpline::shape(0.0), 1);
  EXPECT_DOUBLE_EQ(CubicSpline::shape(1.0), 0.25);
  EXPECT_DOUBLE_EQ(CubicSpline::shape(0.5), 1 - 1.5 * 0.25 + 0.75 * 0.125);
  EXPECT_DOUBLE_EQ(CubicSpline::shape(2.0), 0);
  EXPECT_DOUBLE_EQ(CubicSpline::slope(3), 0);
}

/// Values from the formulas as they are printed, worked out with fractions.
TEST(EveryKernelOf, TheLiteratureHasItsValues) {
  EXPECT_DOUBLE_EQ(QuinticSpline::shape(0.0), 66);
  EXPECT_DOUBLE_EQ(QuinticSpline::shape(1.0), 26);
  EXPECT_DOUBLE_EQ(QuinticSpline::shape(2.0), 1);
  EXPECT_DOUBLE_EQ(QuadraticSpline::shape(0.0), 0.75);
  EXPECT_DOUBLE_EQ(QuadraticSpline::shape(1.0), 3.0 / 16 - 3.0 / 4 + 3.0 / 4);
  EXPECT_DOUBLE_EQ(QuarticSpline::shape(0.0), 14.375);
  EXPECT_DOUBLE_EQ(QuarticSpline::shape(0.5), 11);
  EXPECT_DOUBLE_EQ(QuarticSpline::shape(1.5), 1);
  EXPECT_DOUBLE_EQ(WendlandC2::shape(1.0), 3.0 / 16);
  EXPECT_DOUBLE_EQ(WendlandC4::shape(1.0), (1 + 3 + 35.0 / 12) / 64);
}

TEST(KernelChoice, LeadsToItsKernel) {
  EXPECT_STREQ(kernel_name(KernelChoice::cubic_spline), "cubic spline");
  EXPECT_EQ(kernel_support(KernelChoice::quintic_spline), 3);
  EXPECT_EQ(kernel_support(KernelChoice::quartic_spline), 2.5);
  EXPECT_STREQ(kernel_name(KernelChoice::wendland_c2), "Wendland C2");
  for (const KernelChoice a : every_kernel)
    for (const KernelChoice b : every_kernel)
      EXPECT_EQ(a == b, std::string(kernel_name(a)) == kernel_name(b));
}

/// Work of pressure on pure shear of a square lattice that is sheared so by `strain`, per area, pressure and
/// rate; spacing 1, rows turned by `turn`.
Real work_of_shear(KernelChoice choice, Real h, Real turn, Real strain) {
  const AnyKernel& kernel = any_kernel(choice);
  const int n = int(std::ceil(kernel.support * h)) + 1;
  Real sum = 0;
  for (int a = -n; a <= n; ++a)
    for (int b = -n; b <= n; ++b) {
      if (a == 0 && b == 0) continue;
      const Real x = (a * std::cos(turn) - b * std::sin(turn)) * std::exp(strain);
      const Real y = (a * std::sin(turn) + b * std::cos(turn)) * std::exp(-strain), r = std::hypot(x, y);
      sum += (x * x - y * y) / r * gradient_norm(choice, 2, h) * kernel.gradient(r / h);
    }
  return sum;
}
/// Of the lattice under pressure p, over p; < 0: it yields.
Real shear_stiffness(KernelChoice choice, Real h, Real turn) {
  const Real d = 1e-4;
  return (work_of_shear(choice, h, turn, d) - work_of_shear(choice, h, turn, -d)) / (2 * d);
}

// The table of docs/theory_sph.md: how much the sums of a lattice resist shear that leaves its density as it
// is.
TEST(KernelChoice, SaysHowStiffALatticeUnderPressureIs) {
  const Real diagonal = pi / 4;
  EXPECT_NEAR(shear_stiffness(KernelChoice::cubic_spline, 1.2, 0), 0.282, 5e-4);
  EXPECT_NEAR(shear_stiffness(KernelChoice::cubic_spline, 1.2, diagonal), 0.145, 5e-4);
  EXPECT_NEAR(shear_stiffness(KernelChoice::cubic_spline, 1.5, 0), -0.534, 5e-4);
  EXPECT_NEAR(shear_stiffness(KernelChoice::quintic_spline, 1.2, 0), 0.0125, 5e-5);
  EXPECT_NEAR(shear_stiffness(KernelChoice::quintic_spline, 1.2, diagonal), 0.0146, 5e-5);
  EXPECT_NEAR(shear_stiffness(KernelChoice::wendland_c2, 2, 0), 0.0377, 5e-5);
}

}  // namespace
