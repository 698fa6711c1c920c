// Plates of shells that fall on a rigid floor and on each other.
#include <gtest/gtest.h>

#include "same_bits.hpp"
#include "shell_decks.hpp"

using namespace courant;

namespace {

struct Plates {
  int count = 1, n = 4;
  Real t = 0.002, E = 7e10, ro = 2700, gap = 0.008, drop = 0.01, vdc = 0;
};
constexpr Real wide = 0.2;

/// Square plates of n x n shells, each tilted by some mm, over a held rigid floor with its upper side at z =
/// 0.
std::string falling_plates(const Plates& p) {
  test::ShellDeck deck;
  for (int k = 0; k < p.count; ++k) {
    const Real z = p.drop + 0.5 * p.t + k * (p.t + p.gap);
    const Real a = 0.017 * std::sin(1 + 2 * k), b = 0.017 * std::cos(2 + 3 * k);
    deck.plate(wide, wide, p.n, p.n, k + 1, [=](const Vec& x) {
      const Vec c = x - Vec(wide / 2, wide / 2, 0);
      return Vec(c[0], c[1], z + a * c[0] + b * c[1]);
    });
    deck.cards += fmt::format("*PART\nplate\n{},1,1\n", k + 1);
  }
  deck.plate(2 * wide, 2 * wide, 2, 2, 1000, [](const Vec& x) { return Vec(x - Vec(wide, wide, 0.005)); });
  deck.cards += fmt::format(
      "*SECTION_SHELL\n1,2,,3\n{},,,\n*MAT_ELASTIC\n1,{},{},0.33\n*PART\nfloor\n1000,2,2\n"
      "*SECTION_SHELL\n2,2\n0.01\n*MAT_RIGID\n2,7800,2e11,0.3\n1,7,7\n"
      "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n0.2,0.2,0,0,{}\n\n"
      "*LOAD_BODY_Z\n1,9.81\n*DEFINE_CURVE\n1\n0,1\n1000,1\n",
      p.t, p.ro, p.E, p.vdc);
  return deck.text(1);
}

/// Weight times the way down to the stack, of all. [ML2/T2]
Real fallen(const Plates& p) {
  const Real weight = 9.81 * p.ro * p.t * wide * wide;
  return weight * p.count * (p.drop + 0.5 * (p.count - 1) * p.gap);
}

Real energy_error_of_fall(Simulation& s, const Plates& p) {
  test::energy_error_of_a_step(s);
  return std::abs(s.world().energy.unexplained()) / fallen(p);
}

}  // namespace

// Corners that come to touch and leave again make the step go back and forth. Where it could grow at once, a
// mode of the plate with 1.8 of 2/omega met steps with a period of its own and made 10^5 times the energy.
TEST(FallingPlates, BouncingPlatesRingWithTheEnergyThatTheyFellWith) {
  for (const auto& [count, until] : {std::pair(1, 0.1), {3, 0.06}}) {
    const Plates p{.count = count};
    auto s = test::simulation_of(falling_plates(p));
    test::start_ledger(*s);
    while (s->clock().t < until) s->step(test::do_nothing);
    const Real error = energy_error_of_fall(*s, p);
    std::printf("%d plates: %d steps, energy %.1e\n", count, int(s->clock().cycle), error);
    EXPECT_LT(error, 0.05) << count;
    EXPECT_EQ(s->world().counters.at("leaked_nodes"), 0) << count;
  }
}

// At rest each lies on the one below: thickness by thickness, less the depths of the contact.
TEST(FallingPlates, AStackComesToRestAsHighAsItIsThick) {
  const Plates p{
      .count = 4, .n = 2, .t = 0.004, .E = 1e9, .ro = 1200, .gap = 0.002, .drop = 0.003, .vdc = 20};
  auto s = test::simulation_of(falling_plates(p));
  test::start_ledger(*s);
  while (s->clock().t < 0.2) s->step(test::do_nothing);
  const Real error = energy_error_of_fall(*s, p);
  const World& w = s->world();
  const int nodes = (p.n + 1) * (p.n + 1);
  Real worst = 0;
  for (int k = 0; k < p.count; ++k) {
    Real z = 0;
    for (int i = 0; i < nodes; ++i) z += w.nodes.x.data(2)[k * nodes + i] / nodes;
    worst = std::max(worst, std::abs(z - (k + 0.5) * p.t));
  }
  std::printf("%d steps, %.1e m from its place, kinetic %.1e, energy %.1e\n", int(s->clock().cycle), worst,
              w.energy.kinetic / fallen(p), error);
  EXPECT_LT(worst, 1e-5);
  EXPECT_LT(w.energy.kinetic, 0.01 * fallen(p));
  EXPECT_LT(error, 0.05);
  EXPECT_EQ(w.counters.at("leaked_nodes"), 0);
}

TEST(FallingPlates, GiveTheSameBitsOnAnyThreadsAndAfterARestartInTouch) {
  test::expect_same_bits(falling_plates({.count = 2, .gap = 0.002, .drop = 0.0005}), 1700, 1500);
}
