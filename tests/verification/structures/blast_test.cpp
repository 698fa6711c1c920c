// *LOAD_BLAST_ENHANCED: what a blast gives to plates.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "loads/blast/blast_wave.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;

namespace {

constexpr Real pound = 0.45359237, foot = 0.3048, psi = 6894.757293168361;

/// A free plate of 0.2 x 0.2 and 10 mm steel, 2 x 2, its normal along z, in metres.
ShellDeck plate(const std::string& blast, Real scale = 1) {
  ShellDeck deck;
  deck.plate(0.2 * scale, 0.2 * scale, 2, 2, 1);
  deck.part(1, 0.01 * scale, "*MAT_ELASTIC\n1,7850.0,2.1E11,0.3\n");
  deck.cards += "*SET_SEGMENT\n1\n1,2,5,4\n2,3,6,5\n4,5,8,7\n5,6,9,8\n" + blast;
  return deck;
}
Real mean_speed(const Simulation& s) {
  Real sum = 0, mass = 0;
  const Nodes& nodes = s.world().nodes;
  for (Index n = 0; n < nodes.size(); ++n) sum += nodes.m[n] * nodes.v.data(2)[n], mass += nodes.m[n];
  return sum / mass;
}

}  // namespace

// 1 kg of TNT 2 m above: behind the positive phase the plate has the reflected impulse over its mass by area;
// with the normal the other way, that of the wave that passes. NEGPHS 1.
TEST(Blast, PlatesTakeUpTheImpulse) {
  for (const int kind : {1, 2}) {
    const BlastWave w = blast_wave(kind == 1 ? BlastKind::surface : BlastKind::air, 1 / pound, 2 / foot);
    for (const bool faces : {true, false}) {
      const std::string blast = fmt::format(
          "*LOAD_BLAST_ENHANCED\n5,1.0,0.1,0.1,{},0.0,2,{}\n0.0,0.0,0.0,0.0,0,1.0,1\n*LOAD_BLAST_SEGMENT_"
          "SET\n"
          "5,1\n",
          faces ? 2.0 : -2.0, kind);
      auto s = simulation_of(plate(blast).text(0.01));
      ASSERT_NE(s, nullptr);
      const Real arrival = 1e-3 * w.arrival, end = 1e-3 * (w.arrival + 1.05 * w.duration);
      while (s->clock().t < 0.98 * arrival) s->step(do_nothing);
      EXPECT_EQ(mean_speed(*s), 0);
      while (s->clock().t < end) s->step(do_nothing);
      const Real impulse = 1e-3 * psi * (faces ? w.reflected_impulse : w.incident_impulse);
      EXPECT_NEAR(mean_speed(*s) / (-impulse / 78.5), 1, 0.01) << kind << faces;
    }
  }
}

// The same in millimetres, kilograms and milliseconds (UNIT 6), and with factors (UNIT 5).
TEST(Blast, UnitsAreThoseOfTheDeck) {
  const auto speed = [](const std::string& blast, bool mm) {
    ShellDeck deck = plate(blast, mm ? 1000 : 1);
    std::string text = deck.text(mm ? 5 : 0.005);
    const std::string metre = "*MAT_ELASTIC\n1,7850.0,2.1E11,0.3\n";
    if (mm) text.replace(text.find(metre), metre.size(), "*MAT_ELASTIC\n1,7.85E-6,210.0,0.3\n");
    auto s = simulation_of(text);
    if (!s) return Real(0);
    while (s->clock().t < (mm ? 4.5 : 0.0045)) s->step(do_nothing);
    return mean_speed(*s);
  };
  const std::string segments = "*LOAD_BLAST_SEGMENT_SET\n5,1\n";
  const Real metres =
      speed("*LOAD_BLAST_ENHANCED\n5,1.0,0.1,0.1,2.0,0.0,2,2\n0.0,0.0,0.0,0.0,0,1.0\n" + segments, false);
  EXPECT_LT(metres, -1);
  const Real millimetres =
      speed("*LOAD_BLAST_ENHANCED\n5,1.0,100.,100.,2000.,0.0,6,2\n0.0,0.0,0.0,0.0\n" + segments, true);
  EXPECT_NEAR(millimetres / metres, 1, 1e-4);  // ends of runs differ by part of a step
  const Real factors =
      speed(fmt::format("*LOAD_BLAST_ENHANCED\n5,1.0,0.1,0.1,2.0,0.0,5,2\n{:.9e},{:.9e},1000.0,"
                        "{:.9e},0,1.0\n",
                        1 / pound, 1 / foot, 1 / psi) +
                segments,
            false);
  EXPECT_NEAR(factors / metres, 1, 1e-7);
}

// TBO shifts, SCALEP scales, DEATH ends.
TEST(Blast, HeedsItsFields) {
  const auto speed = [](const std::string& card, const std::string& second, Real until) {
    auto s =
        simulation_of(plate("*LOAD_BLAST_ENHANCED\n" + card + "\n" + second +
                            "\n*LOAD_BLAST_SEGMENT\n5,1,2,5,4,0,0.0,2.0\n5,2,3,6,5,0,0.0,2.0\n5,4,5,8,7,0,0."
                            "0,2.0\n5,5,6,9,8,0,0.0,2.0\n")
                          .text(0.01));
    if (!s) return Real(0);
    while (s->clock().t < until) s->step(do_nothing);
    return mean_speed(*s);
  };
  const BlastWave w = blast_wave(BlastKind::air, 1 / pound, 2 / foot);
  const Real end = 1e-3 * (w.arrival + w.duration);
  const Real twice = speed("5,1.0,0.1,0.1,2.0,0.0,2,2", "0.0,0.0,0.0,0.0,0,1.0,1", 1.1 * end);
  EXPECT_NEAR(twice / (-2e-3 * psi * w.reflected_impulse / 78.5), 1, 0.01);
  EXPECT_NEAR(speed("5,1.0,0.1,0.1,2.0,-0.001,2,2", "0.0,0.0,0.0,0.0,0,1.0,1", 1.1 * end - 0.001) / twice, 1,
              1e-3);
  EXPECT_EQ(speed("5,1.0,0.1,0.1,2.0,0.0,2,2", fmt::format("0.0,0.0,0.0,0.0,0,{},1", 0.9e-3 * w.arrival),
                  1.1 * end),
            0);
}

TEST(Blast, IsRefusedByName) {
  const auto faults = [](const std::string& blast) {
    const std::string text = plate(blast).text(0.01);
    Diagnostics diagnostics;
    ReadOptions options;
    options.open = [text](const std::string&) { return text; };
    Simulation::build("test.k", options, diagnostics);
    return diagnostics.text();
  };
  const auto expect = [&](const std::string& blast, const char* message) {
    EXPECT_NE(faults(blast).find(message), std::string::npos) << message << "\n" << faults(blast);
  };
  const std::string segments = "*LOAD_BLAST_SEGMENT_SET\n5,1\n", second = "0.0,0.0,0.0,0.0\n";
  expect("*LOAD_BLAST_ENHANCED\n5,1.0,0.1,0.1,0.05,0.0,2,2\n" + second + segments,
         "and the fits hold from 0.37 to");
  expect("*LOAD_BLAST_ENHANCED\n5,1.0,0.1,0.1,2.0,0.0,2,4\n" + second + "0,0\n" + segments, "BLAST");
  expect("*LOAD_BLAST_ENHANCED\n5,1.0,0.1,0.1,2.0,0.0,5,2\n" + second + segments, "beside UNIT 5");
  expect("*LOAD_BLAST_SEGMENT_SET\n6,1\n", "charge 6 does not exist");
}

TEST(Blast, HasTheSameBits) {
  test::expect_same_bits(plate("*LOAD_BLAST_ENHANCED\n5,1.0,0.05,0.1,0.5,0.0,2,2\n0.0,0.0,0.0,0.0\n"
                               "*LOAD_BLAST_SEGMENT_SET\n5,1\n")
                             .text(0.01),
                         120, 50);
}
