// Force transducers (*CONTACT_FORCE_TRANSDUCER_PENALTY) on plates that meet edge on edge.
#include <gtest/gtest.h>

#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;

namespace {

/// A plate that is on its edge falls across the upper edge of another one.
std::string plates_edge_on_edge() {
  test::ShellDeck deck;
  deck.plate(0.1, 0.05, 6, 3, 1, [](const Vec& x) { return Vec(x[0] - 0.046, 0.001, x[1] + 0.0021); });
  deck.plate(0.1, 0.05, 6, 3, 2, [](const Vec& x) { return Vec(0, x[0] - 0.05, x[1] - 0.05); });
  for (const int part : {1, 2})
    deck.part(part, 0.002, fmt::format("*MAT_ELASTIC\n{:10}    7850.0   2.1E+11       0.3\n", part));
  deck.velocity([](const Vec& x) { return Vec(0, 0, x[2] > 1e-3 ? -5 : 0); });
  deck.cards +=
      "*CONTACT_AUTOMATIC_GENERAL\n0\n0.0\n1.0\n*CONTACT_FORCE_TRANSDUCER_PENALTY_ID\n         "
      "9upper\n1,0,3\n"
      "*CONTACT_FORCE_TRANSDUCER_PENALTY_ID\n        10lower\n2,0,3\n";
  return deck.text(1);
}

}  // namespace

// Nothing else acts on the plates: what a transducer tells is the change of their momentum.
TEST(Transducers, TellTheForcesOfEdges) {
  auto s = test::simulation_of(plates_edge_on_edge());
  const Nodes& nodes = s->world().nodes;
  const auto told = [&](Id id) {
    for (const auto* one : s->world().passes.all<const InterfaceReporter>())
      if (one->report().id == id) return Vec(one->report().on_surfa);
    return Vec(Vec::Zero());
  };
  const Index half = nodes.size() / 2;
  const auto momentum = [&](Index from) {
    Vec sum = Vec::Zero();
    for (Index n = from; n < from + half; ++n) sum += nodes.m[n] * nodes.v.vec(n);
    return sum;
  };
  Real most = 0;
  while (s->clock().t < 1.5e-4) {
    const Vec before = momentum(0), below = momentum(half);
    const Real old = s->clock().dt_old;
    s->step(test::do_nothing);
    const Real dt = 0.5 * (old + s->clock().dt_old);
    const Vec force = told(9);
    most = std::max(most, force[2]);
    EXPECT_LT((force + told(10)).norm(), 1e-9 * (1 + force.norm()));
    EXPECT_LT((momentum(0) - before - dt * force).norm(), 1e-6 * before.norm());
    EXPECT_LT((momentum(half) - below + dt * force).norm(), 1e-6 * before.norm());
  }
  EXPECT_GT(most, 1000);
}
