// Density diffusion: what it leaves alone, and what it evens out.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "../app/small_scene.hpp"

namespace courant {

namespace {

using test::run;

/// A tank of water, 10 by 10 with spacing 0.1 and c0 = 20, between mirrors, from its hydrostatic pressure;
/// every second particle of a checkerboard has `noise` more pressure.
std::unique_ptr<Simulation> tank(const std::string& more, Real noise) {
  std::string text =
      "*KEYWORD\n*CONTROL_TERMINATION\n5.\n*CONTROL_SPH\n1,0,1e20,2\n0,0,0,0,0,0,0\n*PART\nwater\n1,1,1,1,1\n"
      "*SECTION_SPH\n1,1.2,1,1\n*MAT_NULL\n1,1000.0\n*EOS_LINEAR_POLYNOMIAL\n1,0,4e5\n\n"
      "*HOURGLASS\n1,0,0,0,1e-20,1e-20\n*LOAD_BODY_Y\n1\n*DEFINE_CURVE\n1\n0.,9.81\n10.,9.81\n"
      "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,0,1,0\n0,0,0,1,0,0\n1,0,0,0,0,0\n" +
      more + "*NODE\n";
  std::string elements = "*ELEMENT_SPH\n", pressures = "*INITIAL_STRESS_SPH\n";
  for (int k = 0; k < 100; ++k) {
    const int column = k % 10, row = k / 10;
    text += fmt::format("{},{:.17g},{:.17g},0\n", k + 1, 0.1 * column + 0.05, 0.1 * row + 0.05);
    elements += fmt::format("{},1,10.0\n", k + 1);
    const Real p = 9810 * (0.95 - 0.1 * row) + ((column + row) % 2 == 0 ? noise : 0);
    pressures += fmt::format("{},{:.17g},{:.17g},{:.17g},0,0,0,0\n", k + 1, -p, -p, -p);
  }
  text += elements + pressures + "*END\n";
  return test::build_deck(text);
}

const std::string on = "*COURANT_DENSITY_DIFFUSION\n0.1\n";

/// Mean square of what two neighbours in a row differ by, less the change along the row that goes over two of
/// them.
Real roughness(Simulation& s) {
  std::string who;
  s.evaluate(who);
  const Particles& p = s.world().particles;
  std::vector<Real> pressure(100);
  for (Index i = 0; i < p.active; ++i) pressure[static_cast<std::size_t>(p.id[i] - 1)] = p.p[i];
  Real sum = 0;
  for (std::size_t k = 1; k < 99; ++k) {
    if (k % 10 == 0 || k % 10 == 9) continue;
    const Real bump = pressure[k] - 0.5 * (pressure[k - 1] + pressure[k + 1]);
    sum += bump * bump / 80;
  }
  return sum;
}

TEST(DensityDiffusion, EvensOutACheckerboardOfPressures) {
  const auto with = tank(on, 500), without = tank("", 500);
  run(*with, 0.1), run(*without, 0.1);
  EXPECT_LT(roughness(*with), 0.1 * roughness(*without));
}

TEST(DensityDiffusion, LeavesTheHydrostaticPressureAlone) {
  const auto s = tank(on, 0);
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
  const auto s = tank(on, 500);
  run(*s, 0.5);
  const EnergyLedger e = s->sample("").energy;
  EXPECT_GT(e.dissipated, 0);
  EXPECT_LT(std::abs(e.residual()), 0.03 * e.dissipated);
}

TEST(DensityDiffusion, WithoutStrengthIsNotThere) {
  const auto a = tank("*COURANT_DENSITY_DIFFUSION\n0.\n", 500), b = tank("", 500);
  run(*a, 0.05), run(*b, 0.05);
  for (Index i = 0; i < 100; ++i) EXPECT_EQ(a->world().particles.x.vec(i), b->world().particles.x.vec(i));
  EXPECT_EQ(a->passes().find("density diffusion"), b->passes().find("density diffusion"));
}

}  // namespace

}  // namespace courant
