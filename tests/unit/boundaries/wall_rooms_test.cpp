// Integrals over walls that meet at right angles, against sums over fine grids.
#include <gtest/gtest.h>

#include <cmath>

#include "sph/walls/wall_corner_tables.hpp"
#include "sph/walls/wall_tables.hpp"

namespace courant {
namespace {

/// Sum over midpoints of f(s, t) on [a, 2] x [b, 2].
template <class F>
Real over(Real a, Real b, const F& f) {
  constexpr int n = 300;
  const Real ds = (2 - a) / n, dt = (2 - b) / n;
  Real sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += f(a + (i + 0.5) * ds, b + (j + 0.5) * dt);
  return sum * ds * dt;
}
Real W(Real r2, int dim) {
  const Real R = std::sqrt(r2);
  return R < 2 ? CubicSpline::C(dim) * CubicSpline::shape(R) : 0;
}

TEST(WallCornerTables, HoldWhatIsBeyondASecondWallInThePlane) {
  const WallCornerTables tables(KernelChoice::cubic_spline, 2);
  for (const Real d : {0.1, 0.5, 1.3})
    for (const Real a : {0.0, 0.4, 1.1}) {
      EXPECT_NEAR(tables.plane(d, a), over(a, 1, [&](Real s, Real) { return W(d * d + s * s, 2); }), 1e-4);
      EXPECT_NEAR(tables.moment(d, a), over(a, 1, [&](Real s, Real) { return s * W(d * d + s * s, 2); }),
                  1e-4);
      EXPECT_NEAR(tables.behind(d, a), over(d, a, [&](Real s, Real t) { return W(s * s + t * t, 2); }), 1e-4);
    }
}

TEST(WallCornerTables, HoldWhatIsBeyondASecondAndAThirdWallInSpace) {
  const WallCornerTables tables(KernelChoice::cubic_spline, 3);
  for (const Real d : {0.1, 0.5, 1.3})
    for (const Real a : {0.0, 0.4, 1.1}) {
      const auto at = [&](Real s, Real t) { return W(d * d + s * s + t * t, 3); };
      EXPECT_NEAR(tables.plane(d, a), over(a, -2, at), 3e-4) << d << " " << a;
      EXPECT_NEAR(tables.moment(d, a), over(a, -2, [&](Real s, Real t) { return s * at(s, t); }), 3e-4);
      for (const Real b : {0.0, 0.3, 0.9}) {
        EXPECT_NEAR(tables.plane(d, a, b), over(a, b, at), 3e-4) << d << " " << a << " " << b;
        EXPECT_NEAR(tables.moment(d, a, b), over(a, b, [&](Real s, Real t) { return s * at(s, t); }), 3e-4);
        Real behind = 0, edge = 0;  // slice by slice
        for (int k = 0; k < 100; ++k) {
          const Real z = d + (k + 0.5) * (2 - d) / 100;
          behind += (2 - d) / 100 * tables.plane(z, a, b), edge += (2 - d) / 100 * tables.plane(z, a);
        }
        EXPECT_NEAR(tables.behind(d, a, b), behind, 3e-4);
        EXPECT_NEAR(tables.behind(d, a), edge, 3e-4);
      }
    }
}

TEST(WallCornerTables, MakeUpThePlaneFromItsQuarters) {
  for (const int dim : {2, 3}) {
    const WallCornerTables corners(KernelChoice::wendland_c2, dim);
    const WallTables planes(KernelChoice::wendland_c2, dim);
    for (const Real d : {0.0, 0.3, 0.8, 1.7}) {
      EXPECT_NEAR(2 * corners.plane(d, 0), planes.plane(d), 3e-4);
      if (dim == 3) {
        EXPECT_NEAR(4 * corners.plane(d, 0, 0), planes.plane(d), 5e-4);
      }
      EXPECT_NEAR(2 * corners.behind(d, 0), planes.behind(d), 3e-4);
    }
  }
}

}  // namespace
}  // namespace courant
