// Water that hits a mirror stands off it: no row of particles stays on the mirror, each in one position with
// its image.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "../app/small_scene.hpp"
#include "../sph/kernel_scene.hpp"

namespace courant {

namespace {

/// A column, ten wide and twenty high with spacing 0.1, falls on the mirror y = 0 between two others, at 0.3
/// c0; gravity then presses it on with 1 % of its stiffness.
std::unique_ptr<Simulation> falling_column(Real cslh, int iavis, KernelChoice kernel, Real tssfac) {
  std::string text = "*KEYWORD\n*CONTROL_TERMINATION\n2.\n*CONTROL_TIMESTEP\n0," +
                     fmt::format("{}\n", tssfac) + "*CONTROL_SPH\n1,0,1e20,2\n0,0,0,0,0,0," +
                     std::to_string(iavis) + "\n*PART\nwater\n1,1,1,1,1\n" +
                     test::kernel_cards(kernel, fmt::format("{}", cslh)) +
                     "*MAT_NULL\n1,1000.0\n*EOS_LINEAR_POLYNOMIAL\n1,0,1e5\n\n*HOURGLASS\n1,0,0,0,1e-20,0.1\n"
                     "*LOAD_BODY_Y\n1\n*DEFINE_CURVE\n1\n0.,0.5\n10.,0.5\n"
                     "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,0,1,0\n0,0,0,1,0,0\n1,0,0,0,0,0\n*NODE\n";
  std::string elements = "*ELEMENT_SPH\n", velocities = "*INITIAL_VELOCITY_NODE\n";
  for (int k = 0; k < 200; ++k) {
    text += fmt::format("{},{:.17g},{:.17g},0\n", k + 1, 0.1 * (k % 10) + 0.05, 0.1 * (k / 10) + 0.05);
    elements += fmt::format("{},1,10.0\n", k + 1);
    velocities += fmt::format("{},0,-1.5,0\n", k + 1);
  }
  text += elements + velocities + "*END\n";
  return test::build_deck(text);
}

struct Case {
  Real cslh;
  int iavis;
  KernelChoice kernel = KernelChoice::cubic_spline;
  Real tssfac = 0.9;
};
class MirrorCore : public testing::TestWithParam<Case> {
 protected:
  std::unique_ptr<Simulation> column() const {
    return falling_column(GetParam().cslh, GetParam().iavis, GetParam().kernel, GetParam().tssfac);
  }
};

TEST_P(MirrorCore, KeepsParticlesOffTheMirror) {
  const auto s = column();
  while (s->clock().t < 2) s->step([](World&, const Clock&, const std::string&) {});
  const Particles& p = s->world().particles;
  int on = 0, row = 0;
  for (Index i = 0; i < p.active; ++i) {
    on += p.x.vec(i)[1] < 0.01 ? 1 : 0;
    row += p.x.vec(i)[1] < 0.15 ? 1 : 0;
  }
  EXPECT_EQ(on, 0);
  EXPECT_GE(row, 8);
}

TEST_P(MirrorCore, KeepsEnergy) {
  const auto s = column();
  while (s->clock().t < 2) s->step([](World&, const Clock&, const std::string&) {});
  const EnergyLedger e = s->sample("").energy;
  const Real impact = 0.5 * 2000 * 1.5 * 1.5;
  EXPECT_LT(std::abs(e.residual()), 0.02 * impact);
}

/// A lone particle, too soft to be stopped, goes to the mirror x = 0 from beyond its reach, through it and
/// away.
Real density_after_crossing(KernelChoice kernel) {
  std::string section = test::kernel_cards(kernel);
  section.replace(section.find(",0,0,0,"), 7, ",0.12,0,0,");  // SPHINI
  const auto s = test::build_deck(
      "*KEYWORD\n*CONTROL_TERMINATION\n2.\n*CONTROL_TIMESTEP\n0,0.05\n*CONTROL_SPH\n1,0,1e20,2\n*"
      "PART\nwater\n"
      "1,1,1,1,1\n" +
      section +
      "*MAT_NULL\n1,1000.0,-1e20\n*EOS_LINEAR_POLYNOMIAL\n1,0,100.\n\n*HOURGLASS\n"
      "1,0,0,0,1e-20,1e-20\n*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,1,0,0\n*NODE\n1,0.2,0,0\n"
      "*ELEMENT_SPH\n1,1,10.0\n*INITIAL_VELOCITY\n0\n-1,0,0\n*END\n");
  Real densest = 0;
  const Particles& p = s->world().particles;
  while (s->clock().t < 0.45) {
    s->step([](World&, const Clock&, const std::string&) {});
    densest = std::max(densest, p.rho[0]);
  }
  EXPECT_EQ(s->world().counters.at("mirror_crossings"), 1) << kernel_name(kernel);
  EXPECT_GT(densest, 1100) << kernel_name(kernel);
  return p.rho[0];
}

TEST(MirrorCoreOfEveryKernel, DensityIsAFunctionOfTheDistanceAlsoThroughTheMirror) {
  for (const KernelChoice kernel : every_kernel)
    EXPECT_NEAR(density_after_crossing(kernel), 1000, 1) << kernel_name(kernel);
}

INSTANTIATE_TEST_SUITE_P(Widths, MirrorCore, testing::Values(Case{1.2, 0}, Case{1.5, 0}, Case{1.2, 1}));
INSTANTIATE_TEST_SUITE_P(Kernels, MirrorCore,
                         testing::Values(Case{1.2, 0, KernelChoice::quintic_spline},
                                         Case{1.2, 0, KernelChoice::quadratic_spline},
                                         Case{1.2, 0, KernelChoice::quartic_spline},
                                         Case{1.2, 0, KernelChoice::wendland_c2},
                                         // narrower than the others: the usual step is longer for it
                                         Case{1.2, 0, KernelChoice::wendland_c4, 0.6}));

}  // namespace

}  // namespace courant
