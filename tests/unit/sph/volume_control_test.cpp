// *COURANT_VOLUME_CONTROL: density and positions agree again.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "../app/small_scene.hpp"
#include "sph/core/fields.hpp"

namespace courant {
namespace {

using test::run;

using Positions = std::vector<std::array<double, 2>>;

/// Particles of density 1000 and the given mass. `sphini`: smoothing length [L], 0: from the spacing.
std::string deck_of(const Positions& places, Real mass, const std::string& more, Real sphini = 0) {
  std::string text = fmt::format(
      "*KEYWORD\n*CONTROL_TERMINATION\n50.\n*CONTROL_SPH\n1,0,1e20,2\n0,0,0,0,0,0,0\n*PART\nwater\n1,1,1,1,"
      "1\n"
      "*SECTION_SPH\n1,1.2,1,1,{}\n*MAT_NULL\n1,1000.0\n*EOS_LINEAR_POLYNOMIAL\n1,0,4e5\n\n"
      "*HOURGLASS\n1,0,0,0,1e-20,0.1\n{}*NODE\n",
      sphini, more);
  std::string elements = "*ELEMENT_SPH\n";
  int id = 0;
  for (const auto& [x, y] : places) {
    text += fmt::format("{},{:.17g},{:.17g},0\n", ++id, x, y);
    elements += fmt::format("{},1,{}\n", id, mass);
  }
  return text + elements + "*END\n";
}

/// 10 x 10 places 0.1 apart; a particle of 10 would fit that spacing.
Positions square(double x0, double y0) {
  Positions out;
  for (int k = 0; k < 100; ++k) out.push_back({x0 + 0.1 * (k % 10), y0 + 0.1 * (k / 10)});
  return out;
}

std::string lattice(Real mass, const std::string& more) {
  return deck_of(square(0.05, 0.05), mass, more);
}

const std::string whole_scene =
    "*DEFINE_VECTOR\n1,0,0,0,1,0,0\n2,1,0,0,0,0,0\n3,0,0,0,0,1,0\n4,0,1,0,0,0,0\n"
    "*BOUNDARY_SPH_PERIODIC\n1,2\n3,4\n";
std::string control(Real tau) {
  return fmt::format("*COURANT_VOLUME_CONTROL\n{}\n", tau);
}

const std::string tank_walls =
    "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,0,1,0\n0,0,0,1,0,0\n1,0,0,0,0,0\n*LOAD_BODY_Y\n1\n*DEFINE_"
    "CURVE\n1\n"
    "0.,9.81\n100.,9.81\n";

Real mean_height(const Simulation& s) {
  const Particles& p = s.world().particles;
  return sum(p.active, [&](Index i) { return p.x.vec(i)[1]; }) / static_cast<Real>(p.active);
}

TEST(VolumeControl, BringsTheDensityToWhatThePlacesSay) {
  for (const Real mass : {9.0, 11.0}) {
    const auto s = test::build_deck(lattice(mass, whole_scene + control(0.5)));
    run(*s, 0.3);
    const Particles& p = s->world().particles;
    // d ln(rho)/dt = (100 m / rho - 1) / TAU
    const Real expected = 100 * mass + (1000 - 100 * mass) * std::exp(-0.6);
    for (Index i = 0; i < p.active; ++i) EXPECT_NEAR(p.rho[i], expected, 3) << mass;
  }
}

TEST(VolumeControl, LeavesASurfaceAlone) {
  const auto s = test::build_deck(lattice(10, control(0.01)));  // a block in the void
  run(*s, 0.002);
  Particles& p = s->world().particles;
  const Field<Real>& rate = sph_fields::volume_rate(p);
  for (Index i = 0; i < p.active; ++i) {
    const int column = static_cast<int>(p.id[i] - 1) % 10, row = static_cast<int>(p.id[i] - 1) / 10;
    const int edge = std::min({column, row, 9 - column, 9 - row});
    if (edge == 0) EXPECT_EQ(rate[i], 0) << p.id[i];
    if (edge > 1) EXPECT_LT(std::abs(rate[i]), 5 / 0.01) << p.id[i];
  }
}

/// A drop of one particle, one of two in nearly the same position, and a row.
TEST(VolumeControl, LeavesSprayAlone) {
  Positions places{{0, 0}, {5, 0}, {5.002, 0}, {0, 5}, {0.1, 5}, {0.2, 5}, {0.3, 5}, {0.4, 5}};
  const auto spray = static_cast<Id>(places.size());
  const Positions block = square(20, 0);
  places.insert(places.end(), block.begin(), block.end());
  const auto s = test::build_deck(deck_of(places, 10, control(0.01), 0.12));
  run(*s, 0.002);
  Particles& p = s->world().particles;
  const Field<Real>& rate = sph_fields::volume_rate(p);
  bool any = false;
  for (Index i = 0; i < p.active; ++i) {
    if (p.id[i] <= spray) EXPECT_EQ(rate[i], 0) << p.id[i];
    any = any || rate[i] != 0;
  }
  EXPECT_TRUE(any);  // within the block
}

TEST(VolumeControl, WaterAtRestKeepsItsLevel) {
  const auto with = test::build_deck(lattice(10, tank_walls + control(0.5)));
  const auto without = test::build_deck(lattice(10, tank_walls));
  run(*with, 20), run(*without, 20);
  EXPECT_NEAR(mean_height(*with), mean_height(*without), 0.005);
  const EnergyLedger e = with->sample("").energy;
  EXPECT_LT(e.kinetic, 1e-4 * 1000 * 9.81 * 0.5);
}

TEST(VolumeControl, WaterThatStandsTooFarApartSinksToItsVolume) {
  const auto with = test::build_deck(lattice(8, tank_walls + control(0.5)));
  const auto without = test::build_deck(lattice(8, tank_walls));
  run(*with, 6), run(*without, 6);
  EXPECT_NEAR(mean_height(*with), 0.4, 0.008);  // 100 particles of 0.008 in a tank 1 wide
  EXPECT_GT(mean_height(*without), 0.47);
}

}  // namespace
}  // namespace courant
