#include "post/interpolation.hpp"

#include <gtest/gtest.h>

#include "particle_sets.hpp"

namespace courant {
namespace {

using test::all_of;
using test::Lattice;

std::vector<Real> field(const ParticleFrame& f, const std::function<Real(Real, Real, Real)>& of) {
  std::vector<Real> out;
  for (std::size_t i = 0; i < f.size(); ++i) out.push_back(of(f.x[i], f.y[i], f.z[i]));
  return out;
}

/// Largest error at points of a fine raster that covers a box; edge: how far it stays from the box's sides.
Real largest_error(const ParticleFrame& frame, Interpolation kind,
                   const std::function<Real(Real, Real, Real)>& of, Real edge) {
  const ParticleGrid grid = all_of(frame);
  const std::vector<Real> values = field(frame, of);
  Real worst = 0;
  for (Real x = edge; x <= 0.2 - edge; x += 0.0013)
    for (Real y = edge; y <= 0.1 - edge; y += 0.0017) {
      const PointWeights weights = interpolate(grid, {x, y, 0}, kind);
      EXPECT_FALSE(weights.fallback);
      worst = std::max(worst, std::abs(weighted(grid, weights, values) - of(x, y, 0)));
    }
  return worst;
}

Real linear(Real x, Real y, Real z) {
  return 3 + 20 * x - 50 * y + 7 * z;
}

TEST(Interpolation, MlsIsExactForLinearFieldsOnAnyParticles) {
  for (Real jitter : {0.0, 0.6}) {
    const ParticleFrame frame = test::water({.x1 = 0.2, .jitter = jitter});
    EXPECT_LT(largest_error(frame, Interpolation::mls, linear, 0), 1e-10) << jitter;  // at the edges, too
    EXPECT_GT(largest_error(frame, Interpolation::shepard, linear, 0), 1e-2) << jitter;
  }
}

TEST(Interpolation, ShepardIsExactForConstants) {
  const ParticleFrame frame = test::water({.x1 = 0.2, .jitter = 0.6});
  EXPECT_LT(largest_error(
                frame, Interpolation::shepard, [](Real, Real, Real) { return 4.0; }, 0),
            1e-13);
}

TEST(Interpolation, MlsInSpace) {
  ParticleFrame frame;
  frame.dim = 3;
  const Real dx = 0.01;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      for (int k = 0; k < 8; ++k) {
        const std::size_t n = 3 * frame.size();
        test::add(frame, (i + 0.4 * test::scatter(n)) * dx, (j + 0.4 * test::scatter(n + 1)) * dx, dx,
                  (k + 0.4 * test::scatter(n + 2)) * dx);
      }
  const ParticleGrid grid = all_of(frame);
  const std::vector<Real> values = field(frame, linear);
  for (const Point& x : {Point{0.035, 0.041, 0.027}, Point{0.01, 0.06, 0.068}}) {
    const PointWeights weights = interpolate(grid, x, Interpolation::mls);
    EXPECT_NEAR(weighted(grid, weights, values), linear(x[0], x[1], x[2]), 1e-10);
    EXPECT_NEAR(interpolate(grid, x, Interpolation::shepard).colour, 1, 0.3);
  }
}

TEST(Interpolation, ColourTellsWater) {
  const ParticleFrame frame = test::water({.x1 = 0.2});
  const ParticleGrid grid = all_of(frame);
  EXPECT_NEAR(interpolate(grid, {0.1, 0.05, 0}, Interpolation::shepard).colour, 1, 0.01);
  EXPECT_NEAR(interpolate(grid, {0.1, 0.1, 0}, Interpolation::shepard).colour, 0.5, 0.05);  // on the surface
  EXPECT_EQ(interpolate(grid, {0.1, 0.2, 0}, Interpolation::mls).of.size(), 0u);
  EXPECT_EQ(interpolate(grid, {1e30, -1e30, 0}, Interpolation::mls).colour, 0);
}

TEST(Interpolation, ParticlesInALineFallBackToShepard) {
  ParticleFrame frame;
  for (int i = 0; i < 10; ++i) test::add(frame, 0.005 * i, 0, 0.005);
  const ParticleGrid grid = all_of(frame);
  const PointWeights weights = interpolate(grid, {0.021, 0.001, 0}, Interpolation::mls);
  EXPECT_TRUE(weights.fallback);
  EXPECT_NEAR(weighted(grid, weights, std::vector<Real>(10, 2.0)), 2, 1e-14);
}

TEST(ParticleGrid, FindsWhatALoopOverAllFinds) {
  ParticleFrame frame = test::water({.x1 = 0.1, .jitter = 0.8});
  test::add(frame, 1e6, -1e6, 0.005);  // must not cost a table of 1e14 cells
  const ParticleGrid grid = all_of(frame);
  for (const Point& at : {Point{0.05, 0.05, 0}, Point{0, 0, 0}, Point{1e6, -1e6, 0}}) {
    std::size_t near = 0, all = 0;
    const auto in_reach = [&](const Point& x) { return std::hypot(x[0] - at[0], x[1] - at[1]) < 2 * 0.006; };
    grid.near(at, [&](std::size_t k) { near += in_reach(grid.particles()[k].x); });
    for (std::size_t i = 0; i < frame.size(); ++i) all += in_reach({frame.x[i], frame.y[i], 0});
    EXPECT_EQ(near, all);
    EXPECT_GT(all, 0u);
  }
}

}  // namespace
}  // namespace courant
