// *DAMPING_FREQUENCY_RANGE and _DEFORM: modes in the range decay with one fraction of critical damping, the
// ledger closes, rigid motion and static loads feel nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "beam_decks.hpp"
#include "loads/frequency_range.hpp"
#include "same_bits.hpp"
#include "vibrating_bars.hpp"

using namespace courant;
using test::decay;
using test::Decay;
using test::simulation_of;
using test::start_ledger;

namespace {

constexpr Real cdamp = 0.02, flow = 10, fhigh = 300;

std::string range(bool deform) {
  return fmt::format("*DAMPING_FREQUENCY_RANGE{}\n{:10}{:10}{:10}\n", deform ? "_DEFORM" : "", cdamp, flow,
                     fhigh);
}
/// Along a bar of length 1 its first mode has the frequency `f`: c = 4 f.
std::string material(Real f) {
  return fmt::format("*MAT_ELASTIC\n         1       1.0{:10.3e}       0.0\n", 16 * f * f);
}

}  // namespace

TEST(FrequencyRange, MechanismsFitTheFractionWithinSixPerCent) {
  for (const bool of_stress : {true, false})
    for (const Real ratio : {1.1, 3.0, 30.0, 1e3, 1e5})
      for (const Real xi : {0.001, 0.02, 0.05}) {
        const FrequencyRange fit = fitted_range(xi, 5, 5 * ratio, of_stress);
        for (int k = 0; k <= 100; ++k) {
          const Real w = 2 * pi * 5 * std::pow(ratio, k / 100.0);
          Real loss = 0, more = 1;
          for (std::size_t j = 0; j < fit.time.size(); ++j) {
            const Real x = w * fit.time[j];
            EXPECT_GT(fit.share[j], 0);
            loss += fit.share[j] * x / (1 + x * x),
                more += fit.share[j] * (of_stress ? x * x : 1) / (1 + x * x);
          }
          EXPECT_NEAR(loss / more / (2 * xi), 1, 0.06) << ratio << " " << xi << " " << w;
        }
      }
}

// From the lower end of the range to the upper one; the frequency rises by what mechanisms add to the
// stiffness, or falls by what they add to the mass.
TEST(FrequencyRange, BarsOfSolidsAndShellsDecayAlikeAtAllFrequencies) {
  for (const bool deform : {true, false})
    for (const Real f : {12.0, 55.0, 250.0})
      for (const int elform : {1, 2, 12, 16}) {  // shells by 10 more, but 16
        const std::string deck = elform < 3
                                     ? test::solid_bar(20, elform, range(deform), material(f))
                                     : test::shell_bar(20, elform == 12 ? 2 : 16, range(deform), material(f));
        auto s = simulation_of(deck);
        start_ledger(*s);
        const Decay d = decay(*s, 20, 0, 1, 10);
        EXPECT_NEAR(d.fraction / cdamp, 1, 0.08) << deform << " " << f << " elform " << elform;
        const Real most = std::sqrt(1 + fitted_range(cdamp, flow, fhigh, deform).sum()),
                   rise = d.omega / (2 * pi * f);
        EXPECT_GT(deform ? rise : 1 / rise, 0.997) << f << " elform " << elform;
        EXPECT_LT(deform ? rise : 1 / rise, most) << f << " elform " << elform;
        EXPECT_LT(test::energy_error_of_a_step(*s), 2e-3) << deform << " " << f << " elform " << elform;
      }
}

// Bending at 8.355 Hz, and along the bar at 1293 Hz.
TEST(FrequencyRange, BeamsDecayAlikeInBendingAndAlong) {
  using namespace test::beams;
  for (const bool deform : {true, false})
    for (const std::string& section : {square_1, square_2, std::string("         3\n    1.0E-4\n")})
      for (const bool bends : {true, false}) {
        if (bends && section.find("         3\n") == 0) continue;
        const int n = bends ? 5 : 20;
        BeamDeck deck;
        deck.part(1, section, steel_of_beams);
        deck.line(n, 1, [&](int k) { return k == 0 ? ",7,7" : bends ? "" : ",5,7"; });
        deck.cards += fmt::format("*DAMPING_FREQUENCY_RANGE{}\n      0.02       5.0    2000.0\n",
                                  deform ? "_DEFORM" : "");
        deck.velocity([&](int k) -> Vec {
          const Real x = Real(k - 1) / n, b = 1.875104, c = 0.734096;
          if (k > n + 1) return Vec::Zero();
          if (!bends) return Vec(0.01 * std::sin(0.5 * pi * x), 0, 0);
          return Vec(
              0, 0.01 * (std::cosh(b * x) - std::cos(b * x) - c * (std::sinh(b * x) - std::sin(b * x))), 0);
        });
        auto s = simulation_of(deck.text(2));
        start_ledger(*s);
        const Decay d = decay(*s, n, bends ? 1 : 0, bends ? 0 : 1, 11);
        EXPECT_NEAR(d.fraction / 0.02, 1, bends ? 0.1 : 0.06) << deform << bends << section;
        EXPECT_LT(test::energy_error_of_a_step(*s), 0.01) << deform << bends << section;
      }
}

// Once a second and 160 times below the range; damping of motion takes a little then, that of stress nothing.
TEST(FrequencyRange, StressLeavesABodyThatSpinsAndFliesAlone) {
  test::SolidDeck deck;
  deck.block({1, 0.2, 0.2}, 5, 1, 1, 1);
  deck.cards += "*PART\nbar\n         1         1         1\n*SECTION_SOLID\n         1         1\n" +
                test::light + range(true);
  deck.cards += "*INITIAL_VELOCITY_NODE\n";
  for (std::size_t k = 0; k < deck.nodes.size(); ++k)
    deck.cards += fmt::format("{:10}{:10.3e}{:10.3e}{:10.3e}\n", k + 1, -(deck.nodes[k][1] - 0.1),
                              deck.nodes[k][0] - 0.5, 3.0);
  auto s = simulation_of(deck.text(10));
  start_ledger(*s);
  const Real start = s->world().energy.kinetic;
  while (s->clock().t < 2 * pi) s->step(test::do_nothing);
  sample_energy(s->world(), s->clock());
  EXPECT_NEAR(s->world().energy.kinetic / start, 1, 1e-4);
}

// Parts that PSID names, and those that it does not: only the first loses energy.
TEST(FrequencyRange, ActsOnThePartsOfItsSet) {
  const std::string set = "*SET_PART\n         7\n         2\n*PART\nother\n         2         1         1\n";
  for (const bool deform : {true, false}) {
    std::string card = range(deform);
    card.insert(card.size() - 1, "         7");
    auto s = simulation_of(test::solid_bar(10, 1, card + set));
    start_ledger(*s);
    const Decay d = decay(*s, 10, 0, 1, 8);
    EXPECT_LT(d.fraction, 1e-4) << deform;
  }
}

TEST(FrequencyRange, HasTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  for (const bool deform : {true, false}) {
    test::expect_same_bits(test::solid_bar(40, 1, range(deform)), 40, 17);
    test::expect_same_bits(test::solid_bar(40, 2, range(deform)), 40, 17);
    test::expect_same_bits(test::shell_bar(80, 16, range(deform)), 40, 17);
    using namespace test::beams;
    BeamDeck deck;
    deck.part(1, square_1, steel_of_beams);
    deck.line(80, 1, [](int k) { return k == 0 ? ",7,7" : ""; });
    deck.cards += range(deform);
    deck.velocity([](int k) { return k < 82 ? Vec(0.01, 0.01, 0.01) : Vec(Vec::Zero()); });
    test::expect_same_bits(deck.text(1), 40, 17);
  }
}
