// Density diffusion: what it leaves alone, and what it evens out.
#include <gtest/gtest.h>

#include <cmath>

#include "checkerboard_tank.hpp"

namespace courant {

namespace {

using test::checkerboard_tank;
using test::run;

const std::string on = "*COURANT_DENSITY_DIFFUSION\n0.1\n";

Real roughness_now(Simulation& s) {
  std::string who;
  s.evaluate(who);
  return test::roughness(s);
}

TEST(DensityDiffusion, EvensOutACheckerboardOfPressures) {
  const auto with = checkerboard_tank(on, 500), without = checkerboard_tank("", 500);
  run(*with, 0.1), run(*without, 0.1);
  EXPECT_LT(roughness_now(*with), 0.1 * roughness_now(*without));
}

TEST(DensityDiffusion, LeavesTheHydrostaticPressureAlone) {
  const auto s = checkerboard_tank(on, 0);
  run(*s, 2);
  const Particles& p = s->world().particles;
  Real top = 0, low = 1;
  for (Index i = 0; i < p.active; ++i) {
    top = std::max(top, p.x.vec(i)[1]), low = std::min(low, p.x.vec(i)[1]);
    EXPECT_NEAR(p.rho[i], 1000 + (9810 * (1 - p.x.vec(i)[1])) / 400, 2.5);  // rho g dx / c^2
  }
  EXPECT_NEAR(top, 0.95, 0.02);  // as it began: no creeping rise
  EXPECT_NEAR(low, 0.05, 0.02);
}

TEST(DensityDiffusion, CountsWhatItTakesAsDissipated) {
  const auto s = checkerboard_tank(on, 500);
  run(*s, 0.5);
  const EnergyLedger e = s->sample("").energy;
  EXPECT_GT(e.dissipated, 0);
  EXPECT_LT(std::abs(e.residual()), 0.03 * e.dissipated);
}

TEST(DensityDiffusion, WithoutStrengthIsNotThere) {
  const auto a = checkerboard_tank("*COURANT_DENSITY_DIFFUSION\n0.\n", 500), b = checkerboard_tank("", 500);
  run(*a, 0.05), run(*b, 0.05);
  for (Index i = 0; i < 100; ++i) EXPECT_EQ(a->world().particles.x.vec(i), b->world().particles.x.vec(i));
  EXPECT_EQ(a->passes().find("density diffusion"), b->passes().find("density diffusion"));
}

}  // namespace

}  // namespace courant
