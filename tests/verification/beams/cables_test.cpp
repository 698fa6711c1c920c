// Cables (*MAT_CABLE_DISCRETE_BEAM with *SECTION_BEAM ELFORM 6).
#include <gtest/gtest.h>

#include <cmath>

#include "beam_decks.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;
using test::do_nothing;
using test::expect_same_bits;
using test::simulation_of;
using test::start_ledger;
using test::beams::BeamDeck;

namespace {

const Field<Real>& of_cables(const Simulation& s, const char* name) {
  const auto* field = dynamic_cast<const Field<Real>*>(s.world().groups.at(0)->fields.find(name));
  EXPECT_NE(field, nullptr) << name;
  return *field;
}
Real pull_of(const Simulation& s, Index e = 0) {
  return of_cables(s, "axial_force")[e];
}
void go_to_time(Simulation& s, Real t) {
  while (s.clock().t < t) s.step(do_nothing);
}

/// A cable 2 long, CA 1e-4, 8 kg/m3 x VOL, between nodes 1 and 2 along x; `codes` of node 2.
BeamDeck cable_deck(const std::string& law, const char* codes,
                    const std::string& section = "6\n1e-4,0.0,0,1e-4\n") {
  BeamDeck deck;
  deck.at({0, 0, 0}, ",7,7"), deck.at({2, 0, 0}, codes);
  deck.beam(1, 1, 2);
  deck.part(1, section, "*MAT_CABLE_DISCRETE_BEAM\n" + law + "\n");
  return deck;
}
/// Node 2 goes away from node 1 at `speed`.
std::string driven_end(Real speed) {
  return fmt::format(
      "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,0,1\n*DEFINE_CURVE\n1\n0.0,{0}\n1e9,{0}\n"
      "*CONTROL_TIMESTEP\n0.0,0.1\n",
      speed);
}

}  // namespace

// A weight falls into its cable, K = E CA/L = 1000: z = M g/K (1 - cos w t), w^2 = K/(M + m/2).
TEST(Cables, AWeightSwingsOnItsCable) {
  for (const auto& [tssfac, bound] : {std::pair(0.9, 2e-3), std::pair(0.2, 1e-4)}) {
    BeamDeck deck = cable_deck("1,1000.0,2e7", ",7,7");
    deck.nodes = "1,0.0,0.0,0.0,7,7\n2,0.0,0.0,-2.0,4,7\n";
    deck.cards += fmt::format(
        "*ELEMENT_MASS\n{:8}{:8}{:16}\n*LOAD_BODY_Z\n1\n*DEFINE_CURVE\n1\n0.0,10.0\n1e9,10.0\n"
        "*CONTROL_TIMESTEP\n0.0,{}\n",
        1, 2, 1.95, tssfac);
    auto s = simulation_of(deck.text(10));
    start_ledger(*s);
    const Real M = 2, w = std::sqrt(1000 / M);  // 0.05 of it half the cable's
    Real most = 0;
    while (s->clock().t < 5 * 2 * pi / w) {
      s->step(do_nothing);
      const Real t = s->clock().t, z = 2 + s->world().nodes.x.data(2)[1];
      EXPECT_NEAR(-z, M * 10 / 1000 * (1 - std::cos(w * t)), 0.02 * 32 * bound) << t;
      most = std::max(most, pull_of(*s));
    }
    EXPECT_NEAR(most, 2 * M * 10, 40 * bound);
    EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
  }
}

// Two masses fly apart on a cable that is 0.1 slack, 1000 stiff: it pulls from then on, for half a period
// turns them round, and is slack again. What is exchanged is their momentum, to the last bit but rounding.
TEST(Cables, ASlackCablePullsOnceItIsTaut) {
  BeamDeck deck = cable_deck("1,1e-3,2e7", "", "6\n1e-4,0.0,0,1e-4,-0.1\n");
  deck.nodes = "1,0.0,0.0,0.0\n2,2.0,0.0,0.0\n";
  deck.cards +=
      "*ELEMENT_MASS\n       1       1             1.0\n       2       2             3.0\n"
      "*CONTROL_TIMESTEP\n0.0,0.9\n";
  deck.cards += "*INITIAL_VELOCITY_NODE\n2,1.0,0.0,0.0\n";
  auto s = simulation_of(deck.text(10));
  start_ledger(*s);
  const Nodes& nodes = s->world().nodes;
  go_to_time(*s, 0.09);
  EXPECT_EQ(pull_of(*s), 0);
  EXPECT_EQ(nodes.v.data(0)[0], 0);
  const Real K = 2e7 * 1e-4 / 2.1, reduced = 0.75, half = pi * std::sqrt(reduced / K);
  go_to_time(*s, 0.1 + 0.5 * half);
  EXPECT_NEAR(pull_of(*s), std::sqrt(K * reduced), 1e-3 * std::sqrt(K * reduced));
  go_to_time(*s, 0.1 + half + 0.01);
  EXPECT_EQ(pull_of(*s), 0);
  EXPECT_NEAR(of_cables(*s, "internal_energy")[0], 0, 1e-12) << "a slack cable stores nothing";
  // elastic: v1 = 2 m2/(m1 + m2), v2 = (m2 - m1)/(m1 + m2)
  EXPECT_NEAR(nodes.v.data(0)[0], 1.5, 1e-4);
  EXPECT_NEAR(nodes.v.data(0)[1], 0.5, 1e-4);
  EXPECT_NEAR(nodes.m[0] * nodes.v.data(0)[0] + nodes.m[1] * nodes.v.data(0)[1], nodes.m[1], 1e-12);
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
}

TEST(Cables, OffsetCurveAndStiffnessMakeTheForce) {
  const std::string curve = "*DEFINE_CURVE\n7\n0.0,0.0\n0.1,3e5\n0.2,4e5\n";
  struct Case {
    std::string law, section;
    Real slack, rest;  ///< force from an elongation of `slack` on
    std::function<Real(Real)> N;
  };
  const std::string plain = "6\n1e-4,0.0,0,1e-4\n";
  for (const Case& c :
       {Case{"1,1000.0,2e6", plain, 0, 2, [](Real dL) { return 1e-4 * 2e6 * dL / 2; }},
        Case{"1,1000.0,2e6", "6\n1e-4,0.0,0,1e-4,0.5\n", -0.5, 1.5,
             [](Real dL) { return 1e-4 * 2e6 * dL / 1.5; }},
        Case{"1,1000.0,2e6", "6\n1e-4,0.0,0,1e-4,-0.05\n", 0.05, 2.05,
             [](Real dL) { return 1e-4 * 2e6 * dL / 2.05; }},
        Case{"1,1000.0,-300.0", "6\n1e-4\n", 0, 2, [](Real dL) { return 300 * dL; }},
        Case{"1,1000.0,2e6,0,5.0", plain, 0, 2, [](Real dL) { return 5 + 1e-4 * 2e6 * dL / 2; }},
        Case{"1,1000.0,1.0,7\n" + curve, plain, 0, 2, [](Real dL) {
               const Real e = dL / 2;
               return 1e-4 * (e < 0.1 ? 3e6 * e : 3e5 + 1e6 * (e - 0.1));  // straight beyond its end
             }}}) {
    BeamDeck deck = cable_deck(c.law, ",6,7", c.section);
    deck.nodes = "1,0.0,0.0,0.0,7,7\n2,2.0,0.0,0.0,0,7\n";
    deck.cards += driven_end(0.5);
    auto s = simulation_of(deck.text(10));
    start_ledger(*s);
    const Real before = s->world().energy.initial;
    for (const Real t : {0.02, 0.1, 0.3, 0.6, 1.0}) {
      go_to_time(*s, t);
      const Real length = of_cables(*s, "length")[0], dL = length - c.rest;
      EXPECT_NEAR(length, 2 + 0.5 * (s->clock().t - s->clock().dt_old), 1e-9);
      EXPECT_NEAR(pull_of(*s), c.N(0) > 0 || dL > 0 ? c.N(dL) : 0, 1e-9) << c.law << c.section << t;
    }
    const Real dL = of_cables(*s, "length")[0] - c.rest, from = std::max(-c.slack, Real(0));
    Real work = 0;
    for (int k = 0; k < 10000; ++k) work += (dL - from) / 10000 * c.N(from + (dL - from) * (k + 0.5) / 10000);
    if (c.slack > 0) {  // Simpson over nothing: N begins at dL = 0
      work = 0.5 * c.N(dL) * dL;
    }
    EXPECT_NEAR(of_cables(*s, "internal_energy")[0] - (c.slack < 0 ? 0.5 * c.N(0.5) * 0.5 : 0), work,
                2e-3 * work)
        << c.law << c.section;
    EXPECT_GE(before, 0);
  }
}

// F0 rises from TSTART on, is held until TMAXF0 however far the ends move, and from there on it is F0 + K dL.
TEST(Cables, ATensionRisesIsHeldAndThenSprings) {
  BeamDeck deck = cable_deck("1,1000.0,2e6,0,5.0,0.5,0.2,1\n0,0.1", "", "6\n1e-4,0.0,0,1e-4\n");
  deck.nodes = "1,0.0,0.0,0.0,7,7\n2,2.0,0.0,0.0,0,7\n";
  deck.cards += driven_end(0.1);
  auto s = simulation_of(deck.text(10));
  start_ledger(*s);
  Real held = 0;
  while (s->clock().t < 1) {
    s->step(do_nothing);
    const Real t = s->clock().t - s->clock().dt_old, F = pull_of(*s);
    if (t < 0.5) {
      EXPECT_NEAR(F, 5 * std::clamp((t - 0.1) / 0.2, 0.0, 1.0), 1e-9) << t;
      held = of_cables(*s, "length")[0];
    } else {
      EXPECT_NEAR(F, 5 + 1e-4 * 2e6 / 2 * (of_cables(*s, "length")[0] - held), 1e-9) << t;
    }
  }
  EXPECT_GT(pull_of(*s), 9);
}

TEST(Cables, BreakAtTheirStrainOrForce) {
  for (const auto& [limits, at] : {std::pair("0,0.0,0.0,0.05", 0.1), std::pair("0,0.0,0.0,0.0,10.0", 0.1)}) {
    BeamDeck deck = cable_deck(std::string("1,1000.0,2e6,0,0.0,0.0,0.0,1\n") + limits, "");
    deck.nodes = "1,0.0,0.0,0.0,7,7\n2,2.0,0.0,0.0,0,7\n";
    deck.cards += driven_end(0.1);
    auto s = simulation_of(deck.text(10));
    start_ledger(*s);
    Real last = 0, stretch = 0;
    while (s->clock().t < 2) {
      s->step(do_nothing);
      if (pull_of(*s) > 0) last = pull_of(*s), stretch = of_cables(*s, "length")[0] - 2;
    }
    EXPECT_NEAR(stretch, at, 1e-3) << limits;
    EXPECT_NEAR(last, 10, 0.1) << limits;
    EXPECT_EQ(pull_of(*s), 0);
    for (int k = 0; k < 6; ++k) EXPECT_EQ(s->world().groups.at(0)->corner_force->data(k)[0], 0);
    sample_energy(s->world(), s->clock());
    EXPECT_EQ(s->world().energy.internal, 0);
    EXPECT_NEAR(s->world().energy.dissipated, 0.5 * 10 * 0.1, 0.02);
  }
}

// sqrt(m/K) of a cable alone: 2/w with half its mass at each end.
TEST(Cables, HaveTheStepOfTheirMassAndStiffness) {
  BeamDeck deck = cable_deck("1,1000.0,2e6", "");
  auto s = simulation_of(deck.text(1));
  s->step(do_nothing);
  EXPECT_NEAR(s->clock().dt, 0.9 * std::sqrt(1000 * 1e-4 / (2e6 * 1e-4 / 2)), 1e-9);
  BeamDeck by_area = cable_deck("1,1000.0,2e6", "", "6\n0.0,0.0,0,1e-4\n");  // RO CA L
  auto of_area = simulation_of(by_area.text(1));
  EXPECT_NEAR(of_area->world().groups.at(0)->mass[0], 0.2, 1e-12);
}

namespace {

/// n cables from support to support, 2 apart, that hang 2.5 long as a V at first.
BeamDeck catenary(int n) {
  BeamDeck deck;
  const Real depth = std::sqrt(1.25 * 1.25 - 1);
  for (int k = 0; k <= n; ++k) {
    const Real x = -1 + 2.0 * k / n;
    deck.at({x, 0, -depth * (1 - std::abs(x))}, k == 0 || k == n ? ",7,7" : ",2,7");
  }
  for (int k = 0; k < n; ++k) deck.beam(1, k + 1, k + 2);
  deck.part(1, "6\n0.0,0.0,0,1e-3\n", "*MAT_CABLE_DISCRETE_BEAM\n1,1000.0,1e9\n");
  deck.cards += "*LOAD_BODY_Z\n1\n*DEFINE_CURVE\n1\n0.0,10.0\n1e9,10.0\n*DAMPING_GLOBAL\n0,3.0\n";
  return deck;
}

}  // namespace

// S = 2 a sinh(D/2a), sag a (cosh(D/2a) - 1), with what hangs on each cable: E A is 25 000 times the
// weight.
TEST(Cables, HangInACatenary) {
  Real a = 0.1, b = 10;
  for (int k = 0; k < 100; ++k) {
    const Real m = 0.5 * (a + b);
    (2 * m * std::sinh(1 / m) > 2.5 ? a : b) = m;
  }
  const Real sag = a * (std::cosh(1 / a) - 1);
  std::vector<Real> errors;
  for (const int n : {10, 20, 40}) {
    auto s = simulation_of(catenary(n).text(100));
    start_ledger(*s);
    go_to_time(*s, 12);
    sample_energy(s->world(), s->clock());
    EXPECT_LT(s->world().energy.kinetic, 1e-6);
    errors.push_back(std::abs(-s->world().nodes.x.data(2)[n / 2] / sag - 1));
    // of the first cable: H = 10 a, and what hangs on it down to the middle
    EXPECT_NEAR(pull_of(*s, 0) / std::hypot(10 * a, 12.5 * (n - 1) / n), 1, 0.6 / n / n) << n;
  }
  EXPECT_LT(errors[0], 0.006);
  EXPECT_LT(errors[2], 0.0006);
  for (const std::size_t k : {1u, 2u}) EXPECT_GT(std::log2(errors[k - 1] / errors[k]), 1.6) << k;
}

TEST(Cables, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  BeamDeck deck = catenary(150);
  deck.cards.replace(deck.cards.find("1,1000.0,1e9"), 12,
                     "1,1000.0,1e9,0,1.0,0.002,0.001,1\n0,0.0,0.0,0.0,20.0");
  expect_same_bits(deck.text(1), 200, 90);
}
