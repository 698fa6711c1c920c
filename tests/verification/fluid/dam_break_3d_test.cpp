// 16 000 particles thrown about in a closed box whose walls are separate, unmerged patches: not one may
// leave.
#include <gtest/gtest.h>

#include <chrono>

#include "app/run/simulation.hpp"
#include "parallel/parallel.hpp"
#include "scenes.hpp"

using namespace courant;

class DamBreak : public testing::TestWithParam<const char*> {};

TEST_P(DamBreak, NoParticleLeavesTheBox) {
  auto s = test::simulation("dam_break_3d", {{"soft", GetParam()}});
  const auto start = std::chrono::steady_clock::now();
  const auto nothing = [](World&, const Clock&, const std::string&) {};
  std::int64_t steps = 0;
  Vec low = Vec::Constant(1e30), high = -low;
  for (Index i = 0; i < s->world().nodes.size(); ++i) {
    low = low.cwiseMin(s->world().nodes.x.vec(i));
    high = high.cwiseMax(s->world().nodes.x.vec(i));
  }
  while (s->clock().t < s->model().endtim) {
    s->step(nothing);
    ++steps;
  }
  int outside = 0;
  for (Index i = 0; i < s->world().particles.size(); ++i) {
    const Vec x = s->world().particles.x.vec(i);
    outside += !((x.array() >= low.array()).all() && (x.array() <= high.array()).all());
  }
  sample_energy(s->world(), s->clock());
  const EnergyLedger& e = s->world().energy;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf(
      "SOFT %s: %d particles, %lld steps, %.1f s, %.0f ns per particle and step on %d threads; penetration "
      "%.3g m, "
      "energy residual %.3g of %.3g J\n",
      GetParam(), s->world().particles.size(), static_cast<long long>(steps), seconds,
      1e9 * seconds / (static_cast<double>(steps) * s->world().particles.size()), threads(),
      s->world().maxima.at("max_penetration"), e.residual(), e.throughput);
  EXPECT_GE(s->world().particles.size(), 15000);
  EXPECT_GE(s->model().endtim, 1.0);
  EXPECT_EQ(outside, 0);
  EXPECT_EQ(s->world().counters.at("leaked_particles"), 0);
}

INSTANTIATE_TEST_SUITE_P(Soft, DamBreak, testing::Values("0", "1"));
