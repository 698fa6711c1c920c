// Continuity holds in the middle of the step, to which the velocities belong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cloud.hpp"

using namespace courant;
using courant::test::Cloud;

namespace {

/// drho/dt by particle id. `dt_old`: the step that led here; `back`: particles stand v back before it.
std::vector<Real> density_rates(int dim, bool uniform_h, Real dt_old, Real back,
                                KernelChoice kernel = KernelChoice::cubic_spline) {
  Cloud cloud(dim, dim == 2 ? 12 : 8, 0.01, 0.2);
  Particles& p = cloud.world.particles;
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> u(-1, 1);
  for (Index i = 0; i < p.size(); ++i) {
    p.v.set(i, {u(random), u(random), dim == 3 ? u(random) : 0});
    if (!uniform_h) p.h[i] *= 1 + 0.2 * u(random);
    p.x.set(i, p.x.vec(i) - back * p.v.vec(i));
  }
  cloud.settings.uniform_h = uniform_h;
  cloud.settings.kernel = kernel;
  cloud.neighbours =
      std::make_shared<Neighbours>(cloud.neighbours->skin(), std::nullopt, kernel_support(kernel));
  cloud.make_pairs();
  cloud.refresh();
  cloud.clock.dt_old = dt_old;
  cloud.run_rates();
  std::vector<Real> out(p.size());
  for (Index i = 0; i < p.size(); ++i) out[p.id[i] - 1] = p.drhodt[i];
  return out;
}

Real largest_difference(const std::vector<Real>& a, const std::vector<Real>& b) {
  Real most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

TEST(MiddleOfTheStep, DensityRateIsThatOfThePlacesHalfAStepBack) {
  for (const int dim : {2, 3})
    for (const bool uniform_h : {true, false}) {
      const auto error = [&](Real dt) {
        return largest_difference(density_rates(dim, uniform_h, dt, 0),
                                  density_rates(dim, uniform_h, 0, dt / 2));
      };
      const Real dt = 2e-4, without = largest_difference(density_rates(dim, uniform_h, 0, 0),
                                                         density_rates(dim, uniform_h, 0, dt / 2));
      EXPECT_LT(error(dt), 0.05 * without);
      EXPECT_NEAR(error(dt / 2) / error(dt), 0.25, 0.08);  // second order is left out
    }
}

TEST(MiddleOfTheStep, HoldsForEveryKernel) {
  const Real dt = 2e-4;
  for (const KernelChoice kernel : every_kernel)
    for (const int dim : {2, 3}) {
      const auto half_back = density_rates(dim, true, 0, dt / 2, kernel);
      const Real with = largest_difference(density_rates(dim, true, dt, 0, kernel), half_back);
      const Real without = largest_difference(density_rates(dim, true, 0, 0, kernel), half_back);
      // the curvature of the quadratic spline jumps where pairs leave its support
      const Real part = kernel == KernelChoice::quadratic_spline ? 0.15 : 0.06;
      EXPECT_LT(with, part * without) << kernel_name(kernel) << ", " << dim << "D";
    }
}
