// Water that hits a mirror stands off it: no row of particles stays on the mirror, each in one place with its
// image.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "app/simulation.hpp"

namespace courant {

namespace {

/// A column, ten wide and twenty high with spacing 0.1, falls on the mirror y = 0 between two others, at 0.3
/// c0; gravity then presses it on with 1 % of its stiffness.
std::unique_ptr<Simulation> falling_column(Real cslh, int iavis) {
  std::string text = "*KEYWORD\n*CONTROL_TERMINATION\n2.\n*CONTROL_SPH\n1,0,1e20,2\n0,0,0,0,0,0," +
                     std::to_string(iavis) + "\n*PART\nwater\n1,1,1,1,1\n*SECTION_SPH\n" +
                     fmt::format("1,{},1,1\n", cslh) +
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
  ReadOptions options;
  options.open = [&](const std::string&) { return std::optional<std::string>(text); };
  Diagnostics diagnostics;
  auto s = Simulation::build("deck.k", options, diagnostics);
  if (!s) throw std::runtime_error(diagnostics.text());
  return s;
}

class MirrorCore : public testing::TestWithParam<std::pair<Real, int>> {};

TEST_P(MirrorCore, KeepsParticlesOffTheMirror) {
  const auto s = falling_column(GetParam().first, GetParam().second);
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
  const auto s = falling_column(GetParam().first, GetParam().second);
  while (s->clock().t < 2) s->step([](World&, const Clock&, const std::string&) {});
  const EnergyLedger e = s->sample("").energy;
  const Real impact = 0.5 * 2000 * 1.5 * 1.5;
  EXPECT_LT(std::abs(e.residual()), 0.02 * impact);
}

INSTANTIATE_TEST_SUITE_P(Widths, MirrorCore,
                         testing::Values(std::pair(1.2, 0), std::pair(1.5, 0), std::pair(1.2, 1)));

}  // namespace

}  // namespace courant
