// METHOD 1 of *COURANT_WALL_SUPPORT: water at rest in basins, on both sides of a thin wall and over a block.
// Reference: p = rho0 g (surface - y) on each side, and no motion.
#include <cmath>
#include <fstream>
#include <sstream>

#include "same_bits.hpp"
#include "scenes.hpp"

using namespace courant;

namespace wall_images_test {
namespace {

constexpr Real depth = 0.16, g = 9.81, rho0 = 1000;

/// `n`: rows of the higher level.
std::string baffle(const std::map<std::string, std::string>& parameters) {
  return test::generated_from("tests/verification/scenes/baffle.yaml", parameters);
}
/// How deep water is at x beside the baffle, and everywhere over the block.
Real beside_baffle(Real x, int n) {
  return x < 12 * depth / n ? depth : 0.5 * depth;
}
Real over_block(Real, int) {
  return depth;
}

struct Rest {
  Real pressure_error = 0;  ///< largest, of rho0 g depth
  Real speed = 0;           ///< largest [m/s]
  Real gained = 0;          ///< energy from nowhere, of what water at rest holds [-]
};
/// In the second half of the time until `until`.
Rest at_rest(const std::string& deck, int n, Real until, Real (*depth_at)(Real, int) = beside_baffle) {
  const auto nothing = [](World&, const Clock&, const std::string&) {};
  Diagnostics diagnostics;
  auto s = Simulation::build(deck, {}, diagnostics);
  EXPECT_TRUE(s != nullptr) << diagnostics.text();
  std::string who;
  s->evaluate(who);
  sample_energy(s->world(), s->clock());
  s->world().energy.initial = s->world().energy.total();
  const Particles& p = s->world().particles;
  std::map<Id, Real> mean;  // of each particle; they are sorted again now and then
  Rest rest;
  int samples = 0;
  while (s->clock().t < until) {
    s->step(nothing);
    if (s->clock().t < 0.5 * until) continue;
    for (Index i = 0; i < p.size(); ++i) rest.speed = std::max(rest.speed, p.v.vec(i).norm());
    ++samples;
    for (Index i = 0; i < p.size(); ++i) {
      const Vec x = p.x.vec(i);
      mean[p.id[i]] += p.p[i] - rho0 * g * (depth_at(x[0], n) - x[1]);
    }
  }
  for (const auto& [id, sum] : mean)
    rest.pressure_error = std::max(rest.pressure_error, std::abs(sum) / samples / (rho0 * g * depth));
  sample_energy(s->world(), s->clock());
  const EnergyLedger& e = s->world().energy;
  rest.gained = e.residual() / std::abs(e.initial);
  return rest;
}

}  // namespace

TEST(WallImages, HoldTwoLevelsBesideAThinWall) {
  const Rest mirrors = at_rest(baffle({}), 20, 1), plain = at_rest(baffle({{"method", "0"}}), 20, 1);
  std::printf("pressure within %.2f %% of rho0 g depth, fastest %.5f m/s (METHOD 0: %.1f %%, %.4f m/s)\n",
              100 * mirrors.pressure_error, mirrors.speed, 100 * plain.pressure_error, plain.speed);
  EXPECT_LT(mirrors.pressure_error, 0.02);
  EXPECT_LT(mirrors.speed, 0.005);
  EXPECT_GT(plain.pressure_error, 0.05);  // who is distinguished by this test
  // coarser: the error is that of about half a row
  const Rest coarse = at_rest(baffle({{"n", "10"}}), 10, 1);
  EXPECT_LT(coarse.pressure_error, 0.06);
  EXPECT_LT(coarse.speed, 0.005);
}

// Speed that should not be, rms over all particles and 1.5 s, of that of long waves.
TEST(WallImages, LeaveWaterOverAStepAtRest) {
  // two rows in the height of the step; more take longer, and come out in docs/verification_options.md
  const auto nothing = [](World&, const Clock&, const std::string&) {};
  Diagnostics diagnostics;
  auto s = Simulation::build(test::generated_from("tests/verification/scenes/still_step.yaml", {{"n", "2"}}),
                             {}, diagnostics);
  ASSERT_TRUE(s != nullptr) << diagnostics.text();
  std::string who;
  s->evaluate(who);
  const Particles& p = s->world().particles;
  Real square = 0, largest = 0;
  int samples = 0;
  while (s->clock().t < 3) {
    s->step(nothing);
    if (s->clock().t < 1.5) continue;
    Real sum = 0;
    for (Index i = 0; i < p.active; ++i) sum += p.v.vec(i).squaredNorm();
    square += sum / static_cast<Real>(p.active), ++samples;
    for (Index i = 0; i < p.active; ++i) {
      const Vec x = p.x.vec(i);
      if (std::abs(x[0]) > 0.032 || x[1] > 0.064) continue;
      largest = std::max(largest, std::abs(p.p[i] - rho0 * g * (depth - x[1])) / (rho0 * g * depth));
    }
  }
  const Real rms = std::sqrt(square / samples / (g * depth));
  std::printf("rms %.4f %% of sqrt(g H), pressure beside it within %.2f %% of rho g H\n", 100 * rms,
              100 * largest);
  EXPECT_LT(rms, 0.003);
  EXPECT_LT(largest, 0.02);
}

// Convex corners, where the mirrors of top and sides end, and the corners at its feet.
TEST(WallImages, HoldWaterOverABlock) {
  for (const int n : {10, 20}) {
    const std::string rows = std::to_string(n);
    const std::map<std::string, std::string> size{{"n", rows}, {"high", "0.4 * depth"}};
    const Rest mirrors =
        at_rest(test::generated_from("tests/verification/scenes/block.yaml", size), n, 10.0 / n, over_block);
    std::printf(
        "%d rows: pressure within %.2f %% of rho0 g depth, fastest %.5f m/s, energy from nowhere %.1e\n", n,
        100 * mirrors.pressure_error, mirrors.speed, mirrors.gained);
    EXPECT_LT(mirrors.pressure_error, 0.4 / n);
    EXPECT_LT(mirrors.speed, 0.02);
    EXPECT_LT(std::abs(mirrors.gained), 2e-6);
  }
}

// Water that leaves an edge into the air: the pressure at the bed falls from that of rest to nothing, and
// nothing pulls or rings.
TEST(WallImages, LetWaterLeaveABrink) {
  const int n = 8;
  const std::string deck =
      test::generated_from("tests/verification/scenes/free_overfall.yaml",
                           {{"method", "1"}, {"n", "8"}, {"length", "0.58"}, {"endtim", "1.5"}});
  Diagnostics diagnostics;
  auto s = Simulation::build(deck, {}, diagnostics);
  ASSERT_TRUE(s != nullptr) << diagnostics.text();
  const Particles& p = s->world().particles;
  const Real dx = 0.116 / n;
  Real sum = 0, square = 0;
  int samples = 0;
  while (s->clock().t < 1.5) {
    s->step([](World&, const Clock&, const std::string&) {});
    if (s->clock().t < 0.7) continue;
    for (Index i = 0; i < p.active; ++i) {
      const Vec x = p.x.vec(i);
      if (x[0] < -3 * dx || x[0] > 0 || x[1] > dx) continue;
      const Real pressure = p.p[i] / (rho0 * g * dx);
      sum += pressure, square += pressure * pressure, ++samples;
    }
  }
  const Real mean = sum / samples, deviation = std::sqrt(square / samples - mean * mean);
  std::printf("pressure over three spacings before the brink %.2f rho g dx, deviation %.2f\n", mean,
              deviation);
  EXPECT_GT(mean, 3);  // 8 where nothing flows
  EXPECT_LT(mean, 7);
  EXPECT_LT(deviation, 4);
}

TEST(WallImages, GiveTheSameBitsOnAnyThreadsAndAfterARestart) {
  std::ifstream file(baffle({{"n", "16"}}));
  std::stringstream text;
  text << file.rdbuf();
  test::expect_same_bits(text.str(), 60, 25);
  std::ifstream edges(test::generated_from("tests/verification/scenes/block.yaml", {{"n", "10"}}));
  std::stringstream with_edges;
  with_edges << edges.rdbuf();
  test::expect_same_bits(with_edges.str(), 60, 25);
}
}  // namespace wall_images_test
