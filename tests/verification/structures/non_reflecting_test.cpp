// *BOUNDARY_NON_REFLECTING: waves leave through faces of solids.
#include <gtest/gtest.h>

#include <cmath>

#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

namespace {

constexpr Real pulse_speed = 0.01;  // largest, of what drives

/// A bar of n cubes of side h along x, RO 1000, held so that only `axis` moves; its left end follows v
/// sin^2(pi t/T), `length` long when it travels with `c`, its right end has the card.
std::string bar_with_open_end(int n, int axis, Real length, Real c, const std::string& flags) {
  const Real h = 1.0 / n;
  SolidDeck deck;
  deck.block({1, h, h}, n, 1, 1, 1);
  const std::string held = axis == 0 ? "0,1,1" : axis == 1 ? "1,0,1" : "1,1,0";
  deck.node_set(1, [](const Vec&) { return true; });
  deck.node_set(2, [](const Vec& x) { return x[0] < 1e-9; });
  deck.cards += "*BOUNDARY_SPC_SET\n1,0," + held + "\n";
  // in the order of nodes: y, z = 00, 10, 01, 11
  const int a = n + 1, b = 2 * (n + 1), d = 3 * (n + 1), e = 4 * (n + 1);
  deck.cards +=
      fmt::format("*SET_SEGMENT\n5\n{},{},{},{}\n*BOUNDARY_NON_REFLECTING\n5{}\n", a, b, e, d, flags);
  const Real T = length / c;
  std::string curve;
  for (int k = 0; k <= 100; ++k)
    curve += fmt::format("{},{}\n", T * k / 100, pulse_speed * std::pow(std::sin(pi * k / 100), 2));
  deck.cards += fmt::format(
      "*BOUNDARY_PRESCRIBED_MOTION_SET\n2,{},0,9\n*DEFINE_CURVE\n9\n{}1e9,0.0\n*CONTROL_BULK_VISCOSITY\n1e-"
      "20,"
      "1e-20\n",
      axis + 1, curve);
  deck.cards += "*PART\nbar\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1000.0,1.0E9,0.25\n";
  return deck.text(1);
}
/// E = 1e9, PR = 0.25: K + 4/3 G = 1.2e9, G = 4e8.
Real speed_along(int axis) {
  return std::sqrt((axis == 0 ? 1.2e9 : 4e8) / 1000);
}
/// The largest speed in the bar when the pulse would be back in its middle, over that of the pulse.
Real reflected(const std::string& deck, int axis, Real length) {
  auto s = simulation_of(deck);
  const Real c = speed_along(axis), until = (1.5 + length / 2) / c;
  Real seen = 0;
  while (s->clock().t < until) {
    s->step(do_nothing);
    if (s->clock().t < (0.5 + length / 2) / c)
      for (Index n = 0; n < s->world().nodes.size(); ++n)
        seen = std::max(seen, std::abs(s->world().nodes.v.data(axis)[n]));
  }
  EXPECT_NEAR(seen, pulse_speed, 0.02 * pulse_speed);
  Real most = 0;
  for (Index n = 0; n < s->world().nodes.size(); ++n)
    most = std::max(most, std::abs(s->world().nodes.v.data(axis)[n]));
  return most / pulse_speed;
}

}  // namespace

// Waves of dilatation and of shear, a quarter of the bar long; with AD or AS off the free end sends them
// back.
TEST(NonReflecting, WavesLeave) {
  for (const int axis : {0, 1, 2})
    for (const int n : {50, 100, 200}) {
      const Real share = reflected(bar_with_open_end(n, axis, 0.25, speed_along(axis), ""), axis, 0.25);
      testing::Test::RecordProperty(fmt::format("axis{}_n{}", axis, n), fmt::format("{:.6f}", share));
      EXPECT_LT(share, 0.01) << axis << " " << n;
    }
  EXPECT_GT(reflected(bar_with_open_end(100, 0, 0.25, speed_along(0), ",1,0"), 0, 0.25), 0.95);
  EXPECT_GT(reflected(bar_with_open_end(100, 1, 0.25, speed_along(1), ",0,1"), 1, 0.25), 0.95);
}

// What the dampers take is all that the drive has put in.
TEST(NonReflecting, EnergyIsAccountedFor) {
  auto s = simulation_of(bar_with_open_end(100, 0, 0.25, speed_along(0), ""));
  test::start_ledger(*s);
  while (s->clock().t < 1.6 / speed_along(0)) s->step(do_nothing);
  EXPECT_LT(test::energy_error_of_a_step(*s), 0.01);
  const EnergyLedger& e = s->world().energy;
  EXPECT_NEAR(e.dissipated, e.external_work, 0.01 * e.external_work);
  // rho c v^2 over the pulse, by area and time
  const Real by_hand =
      1000 * speed_along(0) * 1e-4 * pulse_speed * pulse_speed * 3 / 8 * 0.25 / speed_along(0);
  EXPECT_NEAR(e.external_work, by_hand, 0.01 * by_hand);
}

TEST(NonReflecting, SameBitsOnThreadsAndAfterARestart) {
  test::expect_same_bits(bar_with_open_end(20, 0, 0.25, speed_along(0), ""), 60, 25);
}
