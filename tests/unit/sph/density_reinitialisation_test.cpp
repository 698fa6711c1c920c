// *COURANT_DENSITY_REINITIALISATION against the plain fit over all particles, and what it does to water.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "checkerboard_tank.hpp"
#include "cloud.hpp"
#include "sph/core/fields.hpp"
#include "sph/kernel/kernel.hpp"

namespace courant {
namespace {

using test::checkerboard_tank;
using test::Cloud;

Real weight(KernelChoice choice, Real r, Real h) {
  return with_kernel(choice, [&](auto kernel) { return decltype(kernel)::shape(r / h); });
}

/// Value at x_i of the function b0 + b.(x - x_i) that fits the densities best, by its normal equations; of
/// the constant b0 alone where `terms` is 1.
Real fit(const Particles& p, Index i, int terms, KernelChoice kernel) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(terms, terms);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(terms);
  for (Index j = 0; j < p.moving; ++j) {
    const Vec d = p.x.vec(j) - p.x.vec(i);
    const Real w = p.m[j] / p.rho[j] * weight(kernel, d.norm(), p.h[i]);
    Eigen::Vector4d b(1, d[0] / p.h[i], d[1] / p.h[i], d[2] / p.h[i]);
    A += w * b.head(terms) * b.head(terms).transpose();
    right += w * p.rho[j] * b.head(terms);
  }
  return A.fullPivLu().solve(right)[0];
}

/// Density after the next step, of the pass alone.
std::vector<Real> smoothed(Cloud& cloud, bool linear) {
  World& w = cloud.world;
  cloud.settings.reinitialisation = {.every = 10, .linear = linear};
  add_density_reinitialisation(cloud.settings, w, cloud.neighbours, make_pair_volumes(w));
  cloud.refresh();
  cloud.clock.dt_old = 1e-3, cloud.clock.cycle = 10;
  std::fill_n(w.particles.drhodt.data(), w.particles.active, 0.0);
  cloud.run(*w.passes.in_phase(Phase::rates, w).back());
  std::vector<Real> rho;
  for (Index i = 0; i < w.particles.active; ++i)
    rho.push_back(w.particles.rho[i] + cloud.clock.dt_old * w.particles.drhodt[i]);
  return rho;
}

TEST(DensityReinitialisation, GivesWhatTheFitOverAllParticlesGives) {
  for (const int dim : {2, 3})
    for (const bool linear : {false, true})
      for (const KernelChoice kernel : {KernelChoice::cubic_spline, KernelChoice::quintic_spline}) {
        Cloud cloud(dim, dim == 2 ? 15 : 7, 0.01, 0.2);
        cloud.settings.kernel = kernel;
        cloud.neighbours =
            std::make_shared<Neighbours>(cloud.neighbours->skin(), std::nullopt, kernel_support(kernel));
        Particles& p = cloud.world.particles;
        std::mt19937 random(3);
        std::uniform_real_distribution<Real> u(-1, 1);
        for (Index i = 0; i < p.size(); ++i) {
          p.rho[i] = 1000 + 200 * u(random), p.m[i] *= 1 + 0.3 * u(random), p.h[i] *= 1 + 0.2 * u(random);
        }
        const std::vector<Real> rho = smoothed(cloud, linear);
        for (Index i = 0; i < p.active; ++i)
          EXPECT_NEAR(rho[i], fit(p, i, linear ? dim + 1 : 1, kernel), 1e-8) << dim << linear;
      }
}

TEST(DensityReinitialisation, LeastSquaresKeepALinearDensity) {
  for (const bool linear : {false, true}) {
    Cloud cloud(2, 15, 0.01, 0.2);
    Particles& p = cloud.world.particles;
    for (Index i = 0; i < p.size(); ++i) p.rho[i] = 1000 + 3000 * p.x.vec(i)[0] - 2000 * p.x.vec(i)[1];
    const std::vector<Real> rho = smoothed(cloud, linear);
    Real most = 0;
    for (Index i = 0; i < p.active; ++i) most = std::max(most, std::abs(rho[i] - p.rho[i]));
    if (linear)
      EXPECT_LT(most, 1e-9);
    else
      EXPECT_GT(most, 10);  // at the edges, 3600 h/2
  }
}

TEST(DensityReinitialisation, TakesAConstantWhereParticlesStandInALine) {
  Cloud cloud(2, 8, 0.01, 0);
  Particles& p = cloud.world.particles;
  for (Index i = 0; i < p.size(); ++i) {
    p.rho[i] = 1000 + (i % 3);
    p.x.set(i, {0.01 * static_cast<Real>(i), 0.02 * static_cast<Real>(i), 0});
  }
  const std::vector<Real> rho = smoothed(cloud, true);
  for (Index i = 0; i < p.active; ++i) EXPECT_NEAR(rho[i], fit(p, i, 1, KernelChoice::cubic_spline), 1e-9);
  EXPECT_EQ(cloud.world.counters.at("density_mls_to_shepard"), 64);
}

std::string every(int steps, int method) {
  return fmt::format("*COURANT_DENSITY_REINITIALISATION\n{},{}\n", steps, method);
}

void step(Simulation& s) {
  s.step([](World&, const Clock&, const std::string&) {});
}

/// Mean square deviation from the hydrostatic pressure.
Real noise_of(const Simulation& s) {
  const Particles& p = s.world().particles;
  return sum(p.active, [&](Index i) { return std::pow(p.p[i] - 9810 * (1 - p.x.vec(i)[1]), 2); }) / 100;
}

/// Of the energy ledger at the time levels of the steps that follow: it swings from step to step.
Real mean_residual(Simulation& s, int steps) {
  Real total = 0;
  for (int k = 0; k < steps; ++k)
    s.step([&](World&, const Clock&, const std::string& who) { total += s.sample(who).energy.residual(); });
  return total / steps;
}

TEST(DensityReinitialisation, ComesEveryFewStepsAndIsCounted) {
  for (const int method : {0, 1})
    for (const int iavis : {0, 1}) {
      const auto with = checkerboard_tank(every(10, method), 500, iavis),
                 without = checkerboard_tank("", 500, iavis);
      for (int k = 0; k < 10; ++k) step(*with), step(*without);
      EXPECT_EQ(noise_of(*with), noise_of(*without));
      step(*with), step(*without);  // cycle 10
      EXPECT_LT(noise_of(*with), 0.6 * noise_of(*without)) << method << iavis;
      const Real taken = mean_residual(*with, 9), nothing = mean_residual(*without, 9);
      const Real counted = with->sample("").energy.dissipated - without->sample("").energy.dissipated;
      EXPECT_GT(counted,
                0.5);  // of 0.31 = V p^2/2 rho c^2 of the noise alone, and what the block holds as one
      EXPECT_NEAR(taken, nothing, 0.03 * counted) << method << iavis;
    }
}

/// A gas that hits a wall is heated by bulk viscosity, which the equation of state takes a step later: a
/// source of density that is there but not due must not take it away.
TEST(DensityReinitialisation, LeavesTheHeatOfBulkViscosityToTheEquationOfState) {
  const auto energies = [](const std::string& more) {
    test::SmallScene scene;
    scene.control_sph = "\n0,0,0,0,0,0,1";
    scene.eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,9.E5,0.,0.,0.4,0.4\n";
    scene.hourglass = "1,0,0,0,1.5,0.06";
    scene.start = "0.,-3.,0.";
    scene.extra = "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,0,1,0\n" + more;
    const auto s = test::build(scene);
    EXPECT_TRUE(s);
    std::vector<Real> out;
    if (!s) return out;
    for (int k = 0; k < 60; ++k) step(*s);
    EXPECT_GT(s->sample("").energy.dissipated + s->sample("").energy.internal, 0);
    const Particles& p = s->world().particles;
    for (Index i = 0; i < p.active; ++i) out.insert(out.end(), {p.E[i], p.p[i]});
    return out;
  };
  EXPECT_EQ(energies(""), energies(every(1000000, 0)));
}

TEST(DensityReinitialisation, NeverIsNotThere) {
  const auto a = checkerboard_tank(every(0, 1), 500), b = checkerboard_tank("", 500);
  for (int k = 0; k < 30; ++k) step(*a), step(*b);
  for (Index i = 0; i < 100; ++i) EXPECT_EQ(a->world().particles.x.vec(i), b->world().particles.x.vec(i));
  EXPECT_EQ(a->passes(), b->passes());
}

}  // namespace
}  // namespace courant
