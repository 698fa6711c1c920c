// Solids of foam, rubber and materials that relax, and sheets that thin, against closed forms; decks as
// users write them.
#include <gtest/gtest.h>

#include <cmath>

#include "cube_decks.hpp"
#include "pressure_decks.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::driven_cube;
using test::pull_of_cube;
using test::ShellDeck;
using test::simulation_of;
using test::SolidDeck;

namespace {

const std::string crushable_card =
    "*MAT_CRUSHABLE_FOAM\n1,1.0,500.0,0.0,7,0.5\n*DEFINE_CURVE\n7\n0.0,1.0\n0.5,2.0\n0.8,8.0\n";
const std::string springy_card =
    "*MAT_LOW_DENSITY_FOAM\n1,1.0,20.0,7,,0.1\n2.0\n*DEFINE_CURVE\n7\n0.0,0.0\n0.1,1.0\n0.6,1.5\n0.8,8.0\n";
const std::string viscous_card = "*MAT_VISCOELASTIC\n1,1.0,50.0,30.0,10.0,0.05\n";
const std::string rubber_card = "*MAT_BLATZ-KO_RUBBER\n1,1.0,10.0\n";

}  // namespace

// Crushed to 30 %: the work is the area under the curve, 1.75 + ..., less what would spring back.
TEST(FoamsAndRubbers, CrushingTakesTheAreaUnderTheCurve) {
  for (const int n : {1, 3}) {
    auto s = simulation_of(driven_cube(n, crushable_card, "0.0,-0.005\n1e9,-0.005\n", false).text(1e9));
    test::start_ledger(*s);
    for (const auto& [strain, stress, area] :
         {std::tuple{0.25, 1.5, 0.3125}, std::tuple{0.5, 2.0, 0.75}, std::tuple{0.7, 6.0, 1.55}}) {
      test::run_until(*s, strain / 0.005);
      EXPECT_NEAR(pull_of_cube(*s, n), stress, 0.01 * stress) << n;
      sample_energy(s->world(), s->clock());
      EXPECT_NEAR(s->world().energy.external_work, area, 0.01 * area) << n;
    }
    EXPECT_LT(test::energy_error(*s), 0.01);
  }
}

// Compressed to 60 % and back: W of loading 0.05 + 0.625; of the path back the integral of (0.1 + 0.9
// (W/0.675)^2) f.
TEST(FoamsAndRubbers, SoftFoamComesBackWithLessForce) {
  for (const int n : {1, 2}) {
    auto s = simulation_of(
        driven_cube(n, springy_card, "0.0,-0.01\n60.0,-0.01\n60.01,0.01\n1e9,0.01\n", false).text(1e9));
    test::start_ledger(*s);
    test::run_until(*s, 30);
    EXPECT_NEAR(pull_of_cube(*s, n), 1.2, 0.01 * 1.2) << n;
    test::run_until(*s, 60);
    EXPECT_NEAR(pull_of_cube(*s, n), 1.5, 0.01 * 1.5) << n;
    sample_energy(s->world(), s->clock());
    EXPECT_NEAR(s->world().energy.external_work, 0.675, 0.01 * 0.675) << n;
    test::run_until(*s, 90);
    EXPECT_NEAR(pull_of_cube(*s, n), 1.2 * (0.1 + 0.9 * std::pow(0.27 / 0.675, 2)), 0.01) << n;
    test::run_until(*s, 119.9);
    // d(W^3)/3 of loading: of 0.675 come back 0.1 + 0.3 of it
    sample_energy(s->world(), s->clock());
    EXPECT_NEAR(s->world().energy.external_work, 0.675 * (1 - 0.4), 0.01 * 0.675) << n;
    EXPECT_LT(test::energy_error(*s), 0.01);
  }
}

// Held at a strain of 1 %: K + 4/3 G(t) of it while the modulus decays.
TEST(FoamsAndRubbers, StressRelaxesWhileTheStrainIsHeld) {
  for (const int n : {1, 2}) {
    auto s = simulation_of(
        driven_cube(n, viscous_card, "0.0,0.01\n1.0,0.01\n1.0001,0.0\n1e9,0.0\n", true).text(1e9));
    for (const Real t : {5.0, 20.0, 60.0}) {
      test::run_until(*s, t);
      // pulled at a steady rate for 1: the mean of the decay over that time
      const Real G = 10 + 20 * std::exp(-0.05 * t) * std::expm1(0.05) / 0.05;
      const Real stress = (50 + 4 * G / 3) * std::log(1.01);
      EXPECT_NEAR(pull_of_cube(*s, n), stress, 0.01 * stress) << n << " " << t;
    }
  }
}

// Pulled to 1.6 with free sides: G (l - l^(-1 - 2 nu)) over the area at the start.
TEST(FoamsAndRubbers, RubberIsPulledAsInClosedForm) {
  for (const int n : {1, 3}) {
    auto s = simulation_of(driven_cube(n, rubber_card, "0.0,0.005\n1e9,0.005\n", false).text(1e9));
    test::start_ledger(*s);
    for (const Real l : {1.2, 1.6}) {
      test::run_until(*s, (l - 1) / 0.005);
      const Real force = 10 * (l - std::pow(l, -1 - 2 * 0.463));
      EXPECT_NEAR(pull_of_cube(*s, n), force, 0.01 * force) << n << " " << l;
    }
    EXPECT_LT(test::energy_error(*s), 0.01);
  }
}

// A strip drawn in length alone keeps its width by SPC: it thins as it grows, and goes at EPSTHIN; with free
// sides at twice that.
TEST(FoamsAndRubbers, SheetsFailWhereTheyAreThin) {
  for (const bool free_sides : {false, true}) {
    ShellDeck deck;
    deck.plate(1, 1, 2, 2, 1);
    deck.part(
        1, 0.01,
        "*MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY\n1,1.0,1000.0,0.3,1.0,5.0\n0.0,0.0,0,0,0,0.1,0.0,0\n\n\n",
        3);
    deck.hold(1, "x", [](const Vec& x) { return x[0] < 1e-9; });
    deck.hold(2, "y", [&](const Vec& x) { return x[1] < 1e-9 || !free_sides; });
    deck.node_set(3, [](const Vec& x) { return x[0] > 1 - 1e-9; });
    deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,1\n*DEFINE_CURVE\n1\n0.0,0.005\n1e9,0.005\n";
    auto s = simulation_of(deck.text(1e9));
    test::start_ledger(*s);
    while (s->world().counters["deleted_elements"] == 0 && s->clock().t < 100) s->step(do_nothing);
    const Real expected = free_sides ? 0.2 : 0.1;
    EXPECT_NEAR(std::log(1 + 0.005 * s->clock().t), expected, 0.02 * expected) << free_sides;
  }
}

TEST(FoamsAndRubbers, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  for (const std::string& material : {crushable_card, springy_card, viscous_card, rubber_card}) {
    SolidDeck deck;
    deck.block(Vec(4, 3, 2), 8, 6, 4, 1);
    deck.cards = "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n" + material;
    deck.cards += "*INITIAL_VELOCITY\n0\n-2.0,0.5,-1.0\n*RIGIDWALL_PLANAR\n0\n-0.01,0.0,0.0,1.0,0.0,0.0\n";
    test::expect_same_bits(deck.text(100), 60, 25);
  }
}
