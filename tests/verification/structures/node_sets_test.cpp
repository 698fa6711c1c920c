// *CONSTRAINED_NODE_SET against exact frequencies and kept momenta.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

namespace node_sets_test {
namespace {

constexpr Real rho = 1000, E1 = 1e9, E2 = 4e9;

std::string part(int id, Real E) {
  return fmt::format("*PART\nbar\n{0:10}         1{0:10}\n*MAT_ELASTIC\n{0:10}{1:10.1f}{2:10.3g}       0.0\n",
                     id, rho, E);
}
/// Two bars of length 1 along x, side by side, n cells each.
SolidDeck two_bars(int n) {
  SolidDeck deck;
  deck.block(Vec(1, 0.1, 0.1), n, 1, 1, 1);
  deck.block(Vec(1, 0.1, 0.1), n, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(0, 1, 0)); });
  deck.cards = "*SECTION_SOLID\n         1         1\n" + part(1, E1) + part(2, E2);
  return deck;
}
std::string start(const SolidDeck& deck, const std::function<Vec(const Vec&)>& velocity) {
  std::string out = "*INITIAL_VELOCITY_NODE\n";
  for (std::size_t n = 0; n < deck.nodes.size(); ++n) {
    const Vec v = velocity(deck.nodes[n]);
    out += fmt::format("{},{:.16g},{:.16g},{:.16g}\n", n + 1, v[0], v[1], v[2]);
  }
  return out;
}

/// The least omega of sum E_i k_i cot(k_i) = 0, k_i = omega/c_i: bars that are held at one end and joined at
/// the other.
Real exact_frequency() {
  const auto stiffness = [](Real omega) {
    const Real k1 = omega / std::sqrt(E1 / rho), k2 = omega / std::sqrt(E2 / rho);
    return E1 * k1 / std::tan(k1) + E2 * k2 / std::tan(k2);
  };
  Real low = 1, high = std::acos(-1.0) * std::sqrt(E1 / rho) * 0.999;
  for (int it = 0; it < 200; ++it) (stiffness(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  return low;
}

}  // namespace

TEST(NodeSets, BarsThatShareAnEndSwingTogether) {
  for (const int n : {8, 16, 32}) {
    SolidDeck deck = two_bars(n);
    deck.node_set(1, [](const Vec& x) { return x[0] < 1e-9; });
    deck.node_set(2, [](const Vec& x) { return x[0] > 1 - 1e-9; });
    deck.cards +=
        "*BOUNDARY_SPC_SET\n         1         0         1         1         1\n*CONSTRAINED_NODE_SET\n      "
        "   2         1\n";
    const Real omega = exact_frequency();
    deck.cards += start(deck, [&](const Vec& x) {
      const Real k = omega / std::sqrt((x[1] < 0.5 ? E1 : E2) / rho);
      return Vec(std::sin(k * x[0]) / std::sin(k), 0, 0);
    });
    auto s = simulation_of(deck.text(1));
    const Nodes& nodes = s->world().nodes;
    const Index tip1 = n, tip2 = 4 * (n + 1) + n;
    Real before = 0, t0 = 0, crossing = 0;
    while (s->clock().t < 1 && crossing == 0) {
      t0 = s->clock().t;
      s->step(do_nothing);
      const Real now = nodes.x.data(0)[tip1] - 1;
      EXPECT_NEAR(now, nodes.x.data(0)[tip2] - 1, 1e-13);
      if (before > 0 && now <= 0) crossing = t0 + before / (before - now) * (s->clock().t - t0);
      before = now;
    }
    const Real error = std::acos(-1.0) / crossing / omega - 1;
    RecordProperty(fmt::format("n{}", n), fmt::format("{:.5f}", error));
    EXPECT_NEAR(error, 0, n == 8 ? 0.01 : 0.0025) << n;
  }
}

// Along y and z they go their own ways; momentum along each axis is kept, and energy.
TEST(NodeSets, KeepMomentumAndEnergy) {
  SolidDeck deck = two_bars(6);
  deck.node_set(1, [](const Vec& x) { return x[0] > 0.6; });
  deck.cards += "*CONSTRAINED_NODE_SET\n         1         6\n*CONTROL_TIMESTEP\n       0.0       0.2\n";
  deck.cards += start(
      deck, [](const Vec& x) { return x[0] > 0.6 ? Vec(x[1], x[1], 0) : Vec(2, 0, x[1] * (0.6 - x[0])); });
  auto s = simulation_of(deck.text(10));
  const Nodes& nodes = s->world().nodes;
  const auto momentum = [&] {
    Vec p = Vec::Zero();
    for (Index n = 0; n < nodes.size(); ++n) p += nodes.m[n] * nodes.v.vec(n);
    return p;
  };
  test::start_ledger(*s);
  const Vec p = momentum();
  for (int k = 0; k < 1500; ++k) s->step(do_nothing);
  EXPECT_NEAR((momentum() - p).norm(), 0, 1e-10 * p.norm());
  EXPECT_LT(test::energy_error_of_a_step(*s), 2e-3);
  const auto at = [&](int axis, Index n) {
    return nodes.x.data(axis)[n] - deck.nodes[static_cast<std::size_t>(n)][axis];
  };
  EXPECT_NEAR(at(0, 6), at(0, 34), 1e-12);
  EXPECT_NEAR(at(2, 6), at(2, 34), 1e-12);
  EXPECT_GT(std::abs(at(1, 6) - at(1, 34)), 1e-3);
}

// From TF on nothing joins them: momentum that was shared stays with each.
TEST(NodeSets, LetGoAtTheirTime) {
  SolidDeck deck = two_bars(2);
  deck.node_set(1, [](const Vec&) { return true; });
  deck.cards +=
      "*CONSTRAINED_NODE_SET\n         1         7     0.001\n*LOAD_BODY_PARTS\n         1\n*SET_PART_LIST\n "
      "        1\n         2\n*LOAD_BODY_X\n         1     -10.0\n*DEFINE_CURVE\n         "
      "1\n0.0,1.0\n10.0,1.0\n";
  auto s = simulation_of(deck.text(1));
  while (s->clock().t < 0.002) s->step(do_nothing);
  const Nodes& nodes = s->world().nodes;
  const Real t = s->clock().t - 0.5 * s->clock().dt_old;  // of the velocities
  EXPECT_NEAR(nodes.v.data(0)[0], 5 * 0.001, 5 * s->clock().dt_old);
  EXPECT_NEAR(nodes.v.data(0)[nodes.size() - 1], 5 * 0.001 + 10 * (t - 0.001), 10 * s->clock().dt_old);
  EXPECT_GT(s->clock().dt_old, 0);
  EXPECT_LT(s->clock().dt_old, 1e-3);
}

TEST(NodeSets, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  SolidDeck deck = two_bars(40);
  deck.node_set(1, [](const Vec& x) { return x[0] > 0.5; });
  deck.cards += "*CONSTRAINED_NODE_SET\n         1         1   0.00001\n";
  deck.cards +=
      start(deck, [](const Vec& x) { return Vec(std::sin(3 * x[1]), x[0] * x[2], std::cos(x[0])); });
  test::expect_same_bits(deck.text(1), 40, 17);
}

}  // namespace node_sets_test
