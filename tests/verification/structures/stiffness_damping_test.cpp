// *DAMPING_PART_STIFFNESS: modes decay with the fraction beta w/2 of critical damping, the ledger closes, and
// steps stay stable.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "beam_decks.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "vibrating_bars.hpp"

using namespace courant;
using test::Decay;
using test::decay;
using test::light;
using test::simulation_of;
using test::start_ledger;

namespace {

std::string damping(Real coef) {
  return fmt::format("*DAMPING_PART_STIFFNESS\n         1{:10.3e}\n", coef);
}
std::string solid_bar(int n, int elform, Real coef) {
  return test::solid_bar(n, elform, damping(coef));
}
std::string shell_bar(int n, int elform, Real coef) {
  return test::shell_bar(n, elform, damping(coef));
}

Real beta_of(const Simulation& s) {
  const FieldSet& set = s.world().groups.front()->fields;
  for (const auto& field : set.all())
    if (field->info().name == "stiffness_damping_time")
      return dynamic_cast<const Field<Real>&>(*field)[set.size() / 2];
  return 0;
}

}  // namespace

// w = pi/2 c/L = 314.16: beta 4e-4 is 0.0628 of critical, and COEF 0.2 on n elements 0.2 w/w_max, w_max = 2
// n c/L of elements whose own step is dx/c.
TEST(StiffnessDamping, ABarOfSolidsOrShellsDecaysAsInTheory) {
  const Real w = 0.5 * pi * 200;
  for (const int n : {10, 20, 40})
    for (const int elform : {1, 2, 12, 16}) {  // shells by 10 more, but 16
      for (const Real coef : {-4e-4, 0.2}) {
        const std::string deck =
            elform < 3 ? solid_bar(n, elform, coef) : shell_bar(n, elform == 12 ? 2 : 16, coef);
        auto s = simulation_of(deck);
        start_ledger(*s);
        const Decay d = decay(*s, n, 0, 1, 8);
        const Real beta = coef < 0 ? -coef : beta_of(*s);
        EXPECT_NEAR(d.omega / w, 1, 4e-3) << n << " elform " << elform;
        EXPECT_NEAR(d.fraction / (0.5 * beta * w), 1, n == 10 ? 0.02 : 0.01)
            << n << " " << elform << " " << coef;
        // the own step of an element: dx/c, or what its form makes of that
        if (coef > 0)
          EXPECT_NEAR(beta / (0.2 / (200 * n)), 1, elform == 1 ? 0.02 : 0.6) << n << " " << elform;
        if (coef > 0) EXPECT_LE(beta, 0.2 / (200 * n) * (1 + 1e-3));
        EXPECT_LT(test::energy_error_of_a_step(*s), 2e-3) << n << " " << elform << " " << coef;
      }
    }
}

// Bending, 8.355 Hz: beta 2e-4 is 0.0052 of critical, beside other modes that the start has; along the bar,
// pi/2 c/L: beta 1e-5 is 0.041.
TEST(StiffnessDamping, BeamsDecayAsInTheory) {
  using namespace test::beams;
  const std::string truss = "         3\n    1.0E-4\n";
  for (const std::string& section : {square_1, square_2, truss})
    for (const bool bends : {true, false}) {
      if (bends && section == truss) continue;
      const int n = bends ? 5 : 20;
      BeamDeck deck;
      deck.part(1, section, steel_of_beams);
      deck.line(n, 1, [&](int k) { return k == 0 ? ",7,7" : bends ? "" : ",5,7"; });
      const Real beta = bends ? 2e-4 : 1e-5;
      deck.cards += damping(-beta);
      deck.velocity([&](int k) -> Vec {
        const Real x = Real(k - 1) / n, b = 1.875104, c = 0.734096;
        if (k > n + 1) return Vec::Zero();
        if (!bends) return Vec(0.01 * std::sin(0.5 * pi * x), 0, 0);
        return Vec(0, 0.01 * (std::cosh(b * x) - std::cos(b * x) - c * (std::sinh(b * x) - std::sin(b * x))),
                   0);
      });
      auto s = simulation_of(deck.text(2));
      start_ledger(*s);
      const Decay d = decay(*s, n, bends ? 1 : 0, bends ? 0 : 1, bends ? 17 : 9);
      const Real omega = bends ? 2 * pi * 8.355166 : 0.5 * pi * std::sqrt(2.1e11 / 7850);
      EXPECT_NEAR(d.omega / omega, 1, 0.03) << bends << section;
      EXPECT_NEAR(d.fraction / (0.5 * beta * d.omega), 1, bends ? 0.03 : 0.01) << bends << section;
      EXPECT_LT(test::energy_error_of_a_step(*s), 0.01) << bends << section;
    }
}

// Random speeds, and so the highest modes; critical damping of these is where steps are hardest to keep.
TEST(StiffnessDamping, StepsStayStable) {
  for (const int elform : {1, 2, 12, 16})
    for (const Real coef : {0.05, 0.25, 0.9, -1e-3, -1e-1}) {
      auto s = simulation_of(elform < 3 ? solid_bar(10, elform, coef)
                                        : shell_bar(10, elform == 12 ? 2 : 16, coef));
      std::mt19937 random(3);
      std::uniform_real_distribution<Real> any(-1e-3, 1e-3);
      for (int k = 0; k < 3; ++k)
        for (Index i = 0; i < s->world().nodes.size(); ++i)
          if (s->world().nodes.x.data(0)[i] > 1e-9) s->world().nodes.v.data(k)[i] = any(random);
      start_ledger(*s);
      const Real start = s->world().energy.kinetic;
      for (int step = 0; step < 3000; ++step) s->step(test::do_nothing);
      sample_energy(s->world(), s->clock());
      EXPECT_LT(s->world().energy.kinetic, 0.8 * start) << elform << " " << coef;
      EXPECT_LT(test::energy_error_of_a_step(*s), 0.02) << elform << " " << coef;
    }
}

TEST(StiffnessDamping, LeavesABodyThatSpinsAlone) {
  test::SolidDeck deck;
  deck.block({1, 0.2, 0.2}, 5, 1, 1, 1);
  deck.cards += "*PART\nbar\n         1         1         1\n*SECTION_SOLID\n         1         1\n" + light +
                damping(-1e-3);
  deck.cards += "*INITIAL_VELOCITY_NODE\n";
  for (std::size_t k = 0; k < deck.nodes.size(); ++k)
    deck.cards +=
        fmt::format("{:10}{:10.3e}{:10.3e}\n", k + 1, -(deck.nodes[k][1] - 0.1), deck.nodes[k][0] - 0.5);
  auto s = simulation_of(deck.text(10));
  start_ledger(*s);
  const Real start = s->world().energy.kinetic;
  while (s->clock().t < 2 * pi) s->step(test::do_nothing);
  sample_energy(s->world(), s->clock());
  EXPECT_NEAR(s->world().energy.kinetic / start, 1, 1e-4);
}

TEST(StiffnessDamping, HasTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  test::expect_same_bits(solid_bar(40, 1, 0.1), 40, 17);
  test::expect_same_bits(solid_bar(40, 2, -1e-4), 40, 17);
  test::expect_same_bits(shell_bar(80, 2, 0.1), 40, 17);
  using namespace test::beams;
  BeamDeck deck;
  deck.part(1, square_1, steel_of_beams);
  deck.line(80, 1, [](int k) { return k == 0 ? ",7,7" : ""; });
  deck.cards += damping(0.1);
  deck.velocity([](int k) { return k < 82 ? Vec(0.01, 0.01, 0.01) : Vec(Vec::Zero()); });
  test::expect_same_bits(deck.text(1), 40, 17);
}
