// Inlets that hold a level (SURF 3 of *COURANT_INFLOW): the velocity against formulas, and a channel.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "../app/small_scene.hpp"
#include "parallel/parallel.hpp"
#include "sph/inlets/held_level.hpp"

namespace courant {
namespace held_level_test {
namespace {

constexpr Real g_held = 9.81;

TEST(HeldLevel, SteadyFlowKeepsItsVelocity) {
  for (const Real h : {0.1, 0.5, 2.0})
    for (const Real froude : {0.0, 0.1, 0.5, 0.95}) {
      const Real u = froude * std::sqrt(g_held * h), head = h + u * u / (2 * g_held);
      EXPECT_NEAR(velocity_at_head(u, h, head, g_held), u, 1e-12);
      EXPECT_NEAR(depth_at_inlet(head, u, g_held), h, 1e-12);
    }
}

TEST(HeldLevel, KeepsTheInvariantAndTheEnergyHead) {
  const Real H = 0.4;
  for (const auto& [u, h] : {std::pair{0.3, 0.35}, {0.0, 0.3}, {0.5, 0.38}}) {
    const Real leaving = u - 2 * std::sqrt(g_held * h), in = velocity_at_head(u, h, H, g_held);
    EXPECT_NEAR(in - 2 * std::sqrt(g_held * depth_at_inlet(H, in, g_held)), leaving, 1e-12);
    EXPECT_GT(in, u) << "the head inside is too low";
  }
}

TEST(HeldLevel, IsCriticalBeforeADryBedAndOutwardBelowAHigherLevel) {
  EXPECT_NEAR(critical_velocity(0.6, g_held), std::sqrt(g_held * 0.4), 1e-12);
  EXPECT_EQ(velocity_at_head(0, 0, 0.4, g_held), critical_velocity(0.4, g_held));
  EXPECT_LT(velocity_at_head(0, 0.5, 0.4, g_held), 0);
  EXPECT_LT(velocity_at_head(0, 9, 0.4, g_held), 0);
}

/// Long waves between the inlet and a gate, which lets through as sqrt(head): what the gate throws back of a
/// wave is larger than the wave where Fr > 0, so the inlet must take more away.
TEST(HeldLevel, DampsWavesBeforeAGate) {
  const Real h = 0.2, u = 0.28, c = std::sqrt(g_held * h), small = 1e-6;
  // a wave that leaves the flow through the inlet: u' = -c h'/h
  const Real out = velocity_at_head(u - c * small / h, h + small, h + u * u / (2 * g_held), g_held) - u;
  const Real reflected = out + c * small / h;  // of the wave that comes in
  EXPECT_NEAR(reflected / (-c * small / h), (c - u) / (c + u), 1e-4);
}

constexpr Real spacing = 0.024, channel_length = 1.2, held = 0.12;

/// A channel over a symmetry plane, with `rows` of water that move with `u`; `outlet` keeps a lower level.
std::string reservoir(const std::string& level_cards, int rows = 5, Real u = 0.3,
                      const std::string& endtim = "10.", const std::string& extra = "") {
  std::string nodes = "*NODE\n", elements = "*ELEMENT_SPH\n";
  Id id = 0;
  const int columns = static_cast<int>(channel_length / spacing + 0.5);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      nodes += fmt::format("{},{:.6g},{:.6g},0.\n", ++id, (i + 0.5) * spacing, (j + 0.5) * spacing);
      elements += fmt::format("{},1,{:.6g}\n", id, 1000 * spacing * spacing);
    }
  return "*KEYWORD\n*CONTROL_TERMINATION\n" + endtim + "\n*CONTROL_SPH\n1,1,1e20,2\n0,0,0,0,0,0,0\n" +
         fmt::format("*DEFINE_BOX\n1,-1.,{0},-1.,1.,-1.,1.\n2,{1},{0},0.,0.5,0.,0.\n", channel_length,
                     channel_length - 0.4) +
         fmt::format("*DEFINE_SPH_INJECTION_SIMPLIFIED\n2,1.,{},{}\n0.,{},0.,1.,0.,0.\n", held / 2, spacing,
                     held / 2) +
         fmt::format("*INITIAL_VELOCITY\n0\n{},0.,0.\n", u) +
         "*PART\nwater\n1,1,1,1,1\n*PART\ninflow\n2,1,1,1,1\n*SECTION_SPH\n1,1.2,1,1\n*MAT_NULL\n1,1000.0\n"
         "*EOS_LINEAR_POLYNOMIAL\n1,0,1e5\n\n*HOURGLASS\n1,0,0,0,1e-20,0.05\n"
         "*COURANT_DENSITY_DIFFUSION\n0.1\n*COURANT_VOLUME_CONTROL\n0.2\n"
         "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,0,1,0\n" +
         test::gravity_cards + "*COURANT_INFLOW\n" + level_cards + extra + nodes + elements + "*END\n";
}

const std::string plain = fmt::format("2,3,0.,{},0.\n0\n0.2,0.1\n", held);

/// Velocity of the inlet: that of what waits within reach.
Real inlet_velocity(const Particles& p) {
  for (Index i = p.active; i < p.moving; ++i)
    if (p.state[i] == particle_waiting) return p.v.vec(i)[0];
  return 0;
}

TEST(HeldLevel, StartsWithTheFlowInside) {
  const auto s = test::build_deck(reservoir(plain));
  ASSERT_TRUE(s);
  std::string control;
  s->evaluate(control);
  const Particles& p = s->world().particles;
  // of the lattice, whose density is RO: its depth is the held level
  EXPECT_NEAR(inlet_velocity(p), 0.3, 0.01);
  int waiting = 0;
  for (Index i = p.active; i < p.moving; ++i) {
    if (p.state[i] != particle_waiting || p.x.vec(i)[0] < -3 * spacing) continue;
    ++waiting;
    const Real pressure = 1000 * g_held * (held - p.x.vec(i)[1]);
    EXPECT_NEAR(p.p[i], pressure, 1e-6 * pressure);
    EXPECT_NEAR(p.m[i], p.rho[i] * spacing * spacing, 1e-9 * p.m[i]) << "volumes fill the inlet";
  }
  EXPECT_EQ(waiting, 15) << "five rows in three layers";
}

/// Volume that has come in, at the density with which it waits, over that of the discharge.
TEST(HeldLevel, BringsInTheIntegralOfItsDischarge) {
  for (const bool energy : {false, true}) {
    const auto s = test::build_deck(
        reservoir(fmt::format("2,3,0.,{},0.\n0\n0.2,0.1,0.,{}\n", held, int(energy)), 4, 0.35, "3."));
    ASSERT_TRUE(s);
    Real volume = 0, most = 0, least = 9, slow = 0.35;
    const Id first = 4 * 50 + 1;
    while (s->clock().t < 2) {
      s->step([](World&, const Clock&, const std::string&) {});
      const Real u = inlet_velocity(s->world().particles), dt = s->clock().dt;
      slow += (u - slow) * (1 - std::exp(-dt / (20 * std::sqrt(held / g_held))));
      const Real head = held + (energy ? 0 : slow * slow / (2 * g_held));
      volume += u * std::min(held, depth_at_inlet(head, u, g_held)) * dt;
      most = std::max(most, u), least = std::min(least, u);
    }
    const Particles& p = s->world().particles;
    int in = 0;
    for (Index i = 0; i < p.size(); ++i)
      in += p.id[i] >= first && p.state[i] != particle_waiting && p.state[i] != particle_deactivated;
    EXPECT_NEAR(in * spacing * spacing, volume, (0.5 * 5 + 1) * spacing * spacing) << energy;
    EXPECT_GT(in, 100);
    EXPECT_GT(most, 1.1 * least) << "it follows";
  }
}

TEST(HeldLevel, LimitsAndCountsTheDischarge) {
  const auto s = test::build_deck(reservoir(fmt::format("2,3,0.,{},0.\n0\n0.2,0.1,0.012\n", held)));
  ASSERT_TRUE(s);
  while (s->clock().t < 0.2) s->step([](World&, const Clock&, const std::string&) {});
  EXPECT_NEAR(inlet_velocity(s->world().particles), 0.1, 1e-12);
  EXPECT_GT(s->world().counters.at("inlet_at_its_limit"), 50);
}

TEST(HeldLevel, LetsNothingOut) {
  // water 0.192 deep at rest before a level of 0.12
  const auto s = test::build_deck(reservoir(plain, 8, 0));
  ASSERT_TRUE(s);
  while (s->clock().t < 0.3) s->step([](World&, const Clock&, const std::string&) {});
  EXPECT_EQ(inlet_velocity(s->world().particles), 0);
  EXPECT_GT(s->world().counters.at("inlet_held_back"), 50);
}

TEST(HeldLevel, FollowsALevelThatSinks) {
  const std::string sinks = "2,3,0.,0.,0.,9\n0\n0.2,0.05\n";
  const auto s = test::build_deck(
      reservoir(sinks, 5, 0.3, "10.", "*DEFINE_CURVE\n9\n0.,0.12\n0.2,0.12\n0.6,0.084\n20.,0.084\n"));
  ASSERT_TRUE(s);
  Index closed = 0;
  while (s->clock().t < 4) s->step([](World&, const Clock&, const std::string&) {});
  const Particles& p = s->world().particles;
  Real highest = 0;
  for (Index i = 0; i < p.size(); ++i) {
    closed += p.state[i] == particle_deactivated;
    if (i >= p.active && i < p.moving && p.state[i] == particle_waiting && p.x.vec(i)[0] > -3 * spacing)
      highest = std::max(highest, p.x.vec(i)[1]);
  }
  EXPECT_GT(closed, 20) << "rows above the level stay closed";
  EXPECT_LT(highest, 0.096) << "half of the fourth row, none of the fifth";
}

TEST(HeldLevel, HasTheSameBitsOnAnyNumberOfThreads) {
  std::vector<Real> reference;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    const auto s = test::build_deck(reservoir(plain, 4));
    ASSERT_TRUE(s);
    while (s->clock().t < 0.5) s->step([](World&, const Clock&, const std::string&) {});
    const Particles& p = s->world().particles;
    std::vector<Real> state{s->clock().t, s->world().energy.external_work};
    for (const auto* field : {&p.x, &p.v})
      for (int k = 0; k < 2; ++k) state.insert(state.end(), field->data(k), field->data(k) + p.size());
    if (reference.empty()) reference = state;
    EXPECT_TRUE(reference == state) << n << " threads";
  }
  set_threads(0);
}

}  // namespace
}  // namespace held_level_test
}  // namespace courant
