// Solids of one point that bend in hourglass modes: whether the measure of the verdict separates beams that
// yield too far from those that are right.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "elements/solid/mode_watch.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::SolidDeck;

namespace {

constexpr Real beam_length = 40, beam_depth = 4;

/// A cantilever of n elements over its depth, under its weight across or along it ("Z", "X") from the
/// start on.
std::string cantilever(int n, const std::string& control, const char* axis, const std::string& law,
                       int elform = 1) {
  SolidDeck deck;
  deck.block(Vec(beam_length, 2, beam_depth), 10 * n, n > 1 ? n / 2 : 1, n, 1);
  deck.node_set(1, [](const Vec& x) { return x[0] < 1e-9; });
  deck.cards += fmt::format(
      "*PART\nbeam\n1,1,1\n*SECTION_SOLID\n1,{}\n{}*BOUNDARY_SPC_SET\n1,0,1,1,1\n"
      "*LOAD_BODY_{}\n1,1e-3\n*DEFINE_CURVE\n1\n0.,1.\n1000.,1.\n{}",
      elform, law, axis, control);
  return deck.text(100);
}
const std::string beam_steel = "*MAT_ELASTIC\n1,7.85e-6,210.0,0.0\n";

/// The measure, by some looks over two swings.
Real unresisted(const std::string& deck) {
  auto s = test::simulation_of(deck);
  for (int look = 1; look <= 40; ++look) {
    while (s->clock().t < 0.05 * look) s->step(test::do_nothing);
    s->guard().look(s->world(), s->clock());
    s->sample("");
  }
  const auto& maxima = s->world().maxima;
  return maxima.contains("unresisted_modes") ? maxima.at("unresisted_modes") : -1;
}

}  // namespace

// The bending of n layers, each by a linear field of its own, is 1/n^2 of that of the beam.
TEST(SolidModes, ABeamMissesTheBendingOfItsElements) {
  EXPECT_GT(unresisted(cantilever(1, "", "Z", beam_steel)), 1);
  EXPECT_NEAR(unresisted(cantilever(2, "", "Z", beam_steel)), 1.0 / 3, 0.01);
  EXPECT_NEAR(unresisted(cantilever(4, "", "Z", beam_steel)), 1.0 / 15, 0.005);
}

// Rubbers miss what an elastic law of the same moduli does.
TEST(SolidModes, RubbersAreExamined) {
  const Real elastic = unresisted(cantilever(2, "", "Z", "*MAT_ELASTIC\n1,7.85e-6,290.0,0.45\n"));
  EXPECT_GT(elastic, 0.2);
  const std::string mooney = "*MAT_MOONEY-RIVLIN_RUBBER\n1,7.85e-6,0.45,25.0,25.0\n";
  EXPECT_NEAR(unresisted(cantilever(2, "", "Z", mooney)), elastic, 0.02 * elastic);
}

// What is held as the material holds it is not missing; along the beam nothing bends.
TEST(SolidModes, NothingIsMissingOfWhatIsHeldOrDoesNotBend) {
  EXPECT_LT(unresisted(cantilever(2, "*CONTROL_HOURGLASS\n6,1.0\n", "Z", beam_steel)), 0.01);
  EXPECT_LT(unresisted(cantilever(2, "", "X", beam_steel)), 0.01);
  EXPECT_EQ(unresisted(cantilever(2, "", "Z", beam_steel, 2)), -1) << "not examined";
}

// A tenth of the stiffness of the material holds a tenth.
TEST(SolidModes, ASmallerCoefficientHoldsLess) {
  EXPECT_GT(unresisted(cantilever(2, "*CONTROL_HOURGLASS\n6,0.1\n", "Z", beam_steel)), 0.15);
}

// Sections that flow all over are not examined.
TEST(SolidModes, WhatYieldedIsNotExamined) {
  const std::string soft = "*MAT_PLASTIC_KINEMATIC\n1,7.85e-6,210.0,0.0,1e-7,0.0,1.0\n";
  EXPECT_LT(unresisted(cantilever(2, "", "Z", soft)), 0.05);
}

// The verdict counts that energy as internal: of plastic laws, too, where nothing flowed.
TEST(SolidModes, BendingByAssumedStrainsCountsUntilTheMaterialFlows) {
  const auto share = [](const std::string& law) {
    auto s = test::simulation_of(cantilever(1, "*CONTROL_HOURGLASS\n6,1.0\n", "Z", law));
    while (s->clock().t < 0.5) s->step(test::do_nothing);
    s->sample("");
    const EnergyLedger& energy = s->world().energy;
    EXPECT_GT(energy.hourglass, 0) << law;
    return energy.assumed_bending / energy.hourglass;
  };
  const std::string plastic = "*MAT_PLASTIC_KINEMATIC\n1,7.85e-6,210.0,0.0,";
  EXPECT_EQ(share(beam_steel), 1);
  EXPECT_EQ(share(plastic + "10.0,0.0,1.0\n"), 1);
  EXPECT_LT(share(plastic + "1e-7,0.0,1.0\n"), 0.5);
}

TEST(SolidModes, TheMeasureIsTheSameOnAnyNumberOfThreadsAndAfterARestart) {
  test::expect_same_bits(cantilever(2, "", "Z", beam_steel), 400, 200);
}
