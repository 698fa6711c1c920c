#include "post/free_surface.hpp"

#include <gtest/gtest.h>

namespace courant {
namespace {

constexpr Real dx = 0.005;

void add(ParticleFrame& frame, Real x, Real y) {
  frame.x.push_back(x);
  frame.y.push_back(y);
  frame.z.push_back(0);
  frame.V.push_back(dx * dx);
  frame.h.push_back(1.2 * dx);
}

/// Rows of particles on a lattice, 0.1 m wide, its lowest row dx/2 above `bed`.
ParticleFrame column(int rows, Real bed = 0) {
  ParticleFrame frame;
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < rows; ++k) add(frame, (i + 0.5) * dx, bed + (k + 0.5) * dx);
  return frame;
}

Real depth(const ParticleFrame& frame, Real x, Real bed = 0) {
  return FreeSurface(frame, x, x).depth(x, bed);
}

TEST(CubicSpline, IntegratesToOne) {
  for (int dim : {2, 3}) {
    Real sum = 0;
    const Real h = 0.3, dr = 1e-4;
    for (Real r = dr / 2; r < 2 * h; r += dr)
      sum += cubic_spline(r, h, dim) * (dim == 2 ? 2 * pi * r : 4 * pi * r * r) * dr;
    EXPECT_NEAR(sum, 1, 1e-6) << dim;
  }
}

TEST(FreeSurface, FlatWaterIsAsDeepAsItsRows) {
  for (int rows : {2, 4, 10, 17}) {
    EXPECT_NEAR(depth(column(rows), 0.05), rows * dx, 0.1 * dx) << rows;
    EXPECT_NEAR(depth(column(rows), 0.0512), rows * dx, 0.1 * dx) << rows;
  }
  EXPECT_NEAR(depth(column(1), 0.05), dx, 0.15 * dx);  // one row: the kernel reaches below it
  EXPECT_NEAR(depth(column(10, 0.3), 0.05, 0.3), 10 * dx, 0.1 * dx);
}

TEST(FreeSurface, SprayAboveAGapDoesNotCount) {
  ParticleFrame frame = column(8);
  const Real calm = depth(frame, 0.05);
  for (int i = 0; i < 20; ++i)  // a sheet of two rows, 4 dx above the water
    for (int k = 0; k < 2; ++k) add(frame, (i + 0.5) * dx, (12.5 + k) * dx);
  EXPECT_NEAR(depth(frame, 0.05), calm, 1e-12);
  add(frame, 0.05, 9.5 * dx);  // a drop just above the surface
  EXPECT_LT(depth(frame, 0.05), 9 * dx);
}

TEST(FreeSurface, DryBed) {
  EXPECT_EQ(depth(column(8), 0.5), 0);              // no water at that x
  EXPECT_EQ(depth(column(8, 4 * dx), 0.05, 0), 0);  // water hangs 4 dx above the bed
  EXPECT_EQ(depth(ParticleFrame(), 0), 0);
}

}  // namespace
}  // namespace courant
