// Sheets that yield by direction, plasticity with damage, foams, ceramics and concrete: one-element decks as
// users write them, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "cube_decks.hpp"
#include "pressure_decks.hpp"
#include "same_bits.hpp"
#include "same_bits_of_material.hpp"
#include "shell_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::driven_cube;
using test::ShellDeck;
using test::simulation_of;

namespace {

const std::string damage_card = "*MAT_PLASTICITY_WITH_DAMAGE\n1,1.0,1000.0,0.3,1.0,0.0,0.05\n,,,,0.15\n\n\n";
const std::string lemaitre_card = "*MAT_DAMAGE_2\n1,1.0,1000.0,0.3,1.0,0.0\n\n0.02,0.0002,0.5\n\n\n";
const std::string two_curves_card =
    "*MAT_PLASTICITY_COMPRESSION_TENSION\n1,1.0,1000.0,0.3\n7,8\n0.0,0.0\n0\n*DEFINE_CURVE\n7\n0.0,3.0\n1.0,"
    "4.0\n"
    "*DEFINE_CURVE\n8\n0.0,1.0\n1.0,2.0\n";
const std::string metal_foam_card =
    "*MAT_DESHPANDE_FLECK_FOAM\n1,1.0,500.0,0.3,2.121320343559643,0.5\n1.5,3.0,2.5,2.0\n";
const std::string rate_foam_card =
    "*MAT_MODIFIED_CRUSHABLE_FOAM\n1,1.0,500.0,0.0,9,0.5\n*DEFINE_CURVE\n7\n0.0,1.0\n0.5,2.0\n*DEFINE_"
    "CURVE\n8\n0.0,"
    "3.0\n0.5,6.0\n*DEFINE_TABLE_2D\n9\n0.0,7\n0.002,8\n";
const std::string ceramic_card =
    "*MAT_JOHNSON_HOLMQUIST_CERAMICS\n1,3.89e-3,90.16,0.93,0.31,0.0,0.6,0.6\n0.0,0.2,0.0,2.79,1.46,1.0\n"
    "0.005,1.0,130.95,0.0,0.0,0\n";
const std::string concrete_card =
    "*MAT_JOHNSON_HOLMQUIST_CONCRETE\n1,2.44,14.86,0.79,1.60,0.0,0.61,0.048\n0.004,1.0,0.01,7.0,0.016,0.001,"
    "0.8,0.1\n"
    "0.04,1.0,85.0,-171.0,208.0,0\n";

/// A sheet of four elements, 1 x 1, pulled along x with free sides; the direction of rolling at `beta`
/// degrees to x.
ShellDeck pulled_sheet(const std::string& name, Real beta) {
  ShellDeck deck;
  deck.plate(1, 1, 2, 2, 1);
  const std::string hardening = name == "MAT_3-PARAMETER_BARLAT" ? "8.0,1.8,1.4,2.2" : "1.8,1.4,2.2";
  deck.part(1, 0.01,
            fmt::format("*{}\n1,1.0,1000.0,0.3,1,5.0,1.0\n{}\n2\n,,,1.0,0.0,0.0\n,,,,,,{}\n", name, hardening,
                        beta),
            3);
  deck.hold(1, "x", [](const Vec& x) { return x[0] < 1e-9; });
  deck.hold(2, "y", [](const Vec& x) { return x.norm() < 1e-9; });
  deck.node_set(3, [](const Vec& x) { return x[0] > 1 - 1e-9; });
  deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,1\n*DEFINE_CURVE\n1\n0.0,0.001\n1e9,0.001\n";
  return deck;
}

/// On the end of a cube of one element.
Real force_on(Simulation& s) {
  Real sum = 0;
  for (const int corner : {1, 2, 5, 6}) sum += s.world().groups[0]->corner_force->data(3 * corner)[0];
  return std::abs(sum);
}

}  // namespace

// Stretched by 10 %: the width shrinks R/(1 + R) of the plastic strain along, the thickness 1/(1 + R); R00,
// R45 and R90 are those of the card.
TEST(DuctileBrittle, SheetsThinByTheirRatios) {
  for (const std::string name : {"MAT_3-PARAMETER_BARLAT", "MAT_122"})
    for (const auto& [beta, R] : {std::pair{0.0, 1.8}, std::pair{45.0, 1.4}, std::pair{90.0, 2.2}}) {
      auto s = simulation_of(pulled_sheet(name, beta).text(1e9));
      test::start_ledger(*s);
      test::run_until(*s, 100);
      const World& world = s->world();
      Real low = 0, high = 0;  // along x = 1 the mean width of what shears, too
      for (Index n = 0; n < world.nodes.size(); ++n) {
        const Real x = world.nodes.x.data(0)[n], y = world.nodes.x.data(1)[n];
        if (x > 0.9 && y < 0.3) low = y;
        if (x > 0.9 && y > 0.7) high = y;
      }
      const Real stress = 1.0, elastic = -0.3 * stress / 1000;
      const Real across = std::log(high - low) - elastic, along = std::log(1.1) - stress / 1000;
      EXPECT_NEAR(-across / along, R / (1 + R), 0.01) << name << " " << beta;
      EXPECT_LT(test::energy_error(*s), 0.01);
    }
}

// Bent without stretching: points at 0.906 and 0.538 of half the thickness reach EPSMAJ one after the other,
// each at its own curvature; NUMINT of them take the elements away.
TEST(DuctileBrittle, NumintCountsPointsThroughTheThickness) {
  for (const auto& [numint, layer] : {std::pair{1, 0.9061798459}, std::pair{2, 0.5384693101}}) {
    ShellDeck deck;
    deck.plate(1, 1, 1, 1, 1);
    deck.part(1, 0.2,
              fmt::format("*MAT_123\n1,1.0,1000.0,0.3,1.0,5.0\n0.0,0.0,0,0,0,0.0,0.05,{}\n\n\n", numint), 5);
    deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9; });
    deck.hold(2, "xyzXZ", [](const Vec& x) { return x[0] > 1 - 1e-9; });
    deck.node_set(3, [](const Vec& x) { return x[0] > 1 - 1e-9; });
    deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,6,0,1\n*DEFINE_CURVE\n1\n0.0,0.01\n1e9,0.01\n";
    auto s = simulation_of(deck.text(1e9));
    while (s->world().counters["deleted_elements"] == 0 && s->clock().t < 150) s->step(do_nothing);
    const Real expected = 0.05 / (0.1 * layer);
    EXPECT_NEAR(0.01 * s->clock().t, expected, 0.02 * expected) << numint;
  }
}

// Pulled solids: force (1 - D) sigma_y over the area of a bar that keeps its volume.
TEST(DuctileBrittle, DamagedBarsTear) {
  for (const auto& [card, D] : {std::pair{damage_card, (0.0943 - 0.05) / 0.1},
                                std::pair{lemaitre_card, 1.0 / 2000 / 0.0002 * (0.0943 - 0.02)}}) {
    auto s = simulation_of(driven_cube(1, card, "0.0,0.002\n1e9,0.002\n", false).text(1e9));
    test::start_ledger(*s);
    test::run_until(*s, 50);
    const Real plastic = std::log(1.1) - 0.001;
    EXPECT_NEAR(plastic, 0.0943, 1e-4);
    EXPECT_NEAR(force_on(*s), (1 - D) / 1.1, 0.01) << card;
    EXPECT_LT(test::energy_error(*s), 0.01);
    while (s->world().counters["deleted_elements"] == 0 && s->clock().t < 2000) s->step(do_nothing);
    EXPECT_EQ(s->world().counters["deleted_elements"], 1) << card;
  }
}

// Pulled and pressed bars follow the curve of their side.
TEST(DuctileBrittle, BarsHaveTwoCurves) {
  for (const Real v : {0.002, -0.002}) {
    auto s =
        simulation_of(driven_cube(1, two_curves_card, fmt::format("0.0,{0}\n1e9,{0}\n", v), false).text(1e9));
    test::run_until(*s, 50);
    const Real l = 1 + 50 * v, first = v > 0 ? 1 : 3, e = std::abs(std::log(l)) - (first + 0.1) / 1000;
    const Real force = (first + e) / l;
    EXPECT_NEAR(force_on(*s), force, 0.01 * force) << v;
  }
}

// Metal foam with ALPHA^2 = 9/2 keeps its width: the force is the yield stress at the logarithmic plastic
// strain.
TEST(DuctileBrittle, MetalFoamIsCrushed) {
  auto s = simulation_of(driven_cube(1, metal_foam_card, "0.0,-0.002\n1e9,-0.002\n", false).text(1e9));
  test::start_ledger(*s);
  for (const Real l : {0.8, 0.5, 0.3}) {
    test::run_until(*s, (1 - l) / 0.002);
    const auto yield = [](Real e) { return 2 + 0.5 * e / 1.5 - 3 * std::log(1 - std::pow(e / 1.5, 2.5)); };
    Real e = -std::log(l);
    for (int k = 0; k < 20; ++k) e = -std::log(l) - yield(e) / 500;
    const Real force = yield(e) * std::pow(1 + 0.3 * yield(e) / 500, 2);  // it widens elastically
    EXPECT_NEAR(force_on(*s), force, 0.01 * force) << l;
  }
  EXPECT_LT(test::energy_error(*s), 0.01);
}

// Crushed slowly by the lower curve, fast by the upper, at half of its rate between; the true rate rises with
// 1/l.
TEST(DuctileBrittle, FoamIsStifferAtHighRates) {
  for (const Real v : {1e-4, 7.5e-4, 0.01}) {
    auto s = simulation_of(
        driven_cube(1, rate_foam_card, fmt::format("0.0,-{0}\n1e9,-{0}\n", v), false).text(1e9));
    test::run_until(*s, 0.25 / v);
    const Real weight = std::min(v / 0.75 / 0.002, 1.0);
    const Real stress = (1 - weight) * 1.5 + weight * 4.5;
    EXPECT_NEAR(force_on(*s), stress, 0.02 * stress) << v;
  }
}

// Squeezed without lateral strain: pressure by the law, the deviator at A (P* + T*)^N or A (1 - D) + B P*^N.
TEST(DuctileBrittle, CeramicsAndConcreteAreSqueezed) {
  auto s = simulation_of(driven_cube(1, ceramic_card, "0.0,-1e-3\n1e9,-1e-3\n", true).text(1e9));
  test::run_until(*s, 8);  // still elastic
  const Real mu = 1 / 0.992 - 1;
  const Real stress = 130.95 * mu + 4.0 / 3 * 90.16 * -std::log(0.992);
  EXPECT_NEAR(force_on(*s), stress, 0.01 * stress);
  test::run_until(*s, 40);  // broken, and swollen: between what BETA 0 and all of the energy of shear give
  const Real pressure = 130.95 * (1 / 0.96 - 1);
  EXPECT_GT(force_on(*s), pressure + 2.0 / 3 * 1.995 * 0.31 * std::pow(pressure / 1.46, 0.6));

  auto c = simulation_of(driven_cube(1, concrete_card, "0.0,-1e-3\n1e9,-1e-3\n", true).text(1e9));
  test::start_ledger(*c);
  test::run_until(*c, 50);
  const Real crushed = 1 / 0.95 - 1, locks = 0.1 + 1.1 * 0.0095943;
  const Real p = 0.016 + 0.784 * (crushed - 0.001) / (locks - 0.001);
  const Real least = 0.048 * 1.6 * std::pow(p / 0.048, 0.61), most = least + 0.048 * 0.79;
  EXPECT_GT(force_on(*c), 0.99 * (p + 2.0 / 3 * least));
  EXPECT_LT(force_on(*c), 1.01 * (p + 2.0 / 3 * most));
  EXPECT_LT(test::energy_error(*c), 0.01);
}

TEST(DuctileBrittle, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  for (const std::string& material : {damage_card, lemaitre_card, two_curves_card, metal_foam_card,
                                      rate_foam_card, ceramic_card, concrete_card})
    test::expect_same_bits_of_block(material);
  for (const std::string name : {"MAT_3-PARAMETER_BARLAT", "MAT_HILL_3R"}) {
    ShellDeck deck = pulled_sheet(name, 30);
    deck.cards += "*INITIAL_VELOCITY\n0\n1.0,0.5,2.0\n";
    test::expect_same_bits(deck.text(100), 60, 25);
  }
}
