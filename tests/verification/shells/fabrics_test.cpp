// Sheets of *MAT_034 against closed forms: fibres pulled and sheared by their curves, wrinkles, membranes.
#include <gtest/gtest.h>

#include <cmath>

#include "pressure_decks.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;

namespace {

/// A unit square of n x n shells of ELFORM 5 whose edge y = 0 is at rest while y = 1 moves along `axis` as
/// curve 1 has it. `free_sides`: nothing holds x of the nodes between.
ShellDeck fabric_square(int n, const std::string& material, int axis, const std::string& motion,
                        bool free_sides, int elform = 5) {
  ShellDeck deck;
  deck.plate(1, 1, n, n, 1);
  deck.cards = fmt::format("*PART\nsheet\n1,1,1\n*SECTION_SHELL\n1,{}\n0.01\n{}", elform, material);
  deck.hold(1, "z", [](const Vec&) { return true; });
  deck.hold(2, free_sides ? "y" : "xy", [](const Vec& x) { return x[1] < 1e-9; });
  if (free_sides) deck.hold(3, "x", [](const Vec& x) { return x[0] < 1e-9; });
  if (!free_sides) deck.hold(4, axis == 1 ? "y" : "x", [](const Vec&) { return true; });
  deck.node_set(5, [](const Vec& x) { return x[1] > 1 - 1e-9; });
  deck.cards += fmt::format("*BOUNDARY_PRESCRIBED_MOTION_SET\n5,{},0,1\n*DEFINE_CURVE\n1\n{}", axis, motion);
  for (int row = 1; axis == 1 && row < n; ++row) {  // sides that go along with a shear
    const Real y = static_cast<Real>(row) / n;
    deck.node_set(
        5 + row, [&](const Vec& x) { return std::abs(x[1] - y) < 1e-9 && (x[0] < 1e-9 || x[0] > 1 - 1e-9); });
    deck.cards += fmt::format("*BOUNDARY_PRESCRIBED_MOTION_SET\n{},1,0,1,{}\n", 5 + row, y);
  }
  return deck;
}

/// What the sheet pulls back with at y = 1, over its thickness.
Real fabric_force(Simulation& s, int n, int axis) {
  const BlockSums& sums = *s.world().groups[0]->sums;
  Real sum = 0;
  for (std::size_t p = 0; p < sums.nodes().size(); ++p)
    if (sums.nodes()[p] >= n * (n + 1))
      sum -= sums.force.vec(static_cast<Index>(p))[axis];  // of the last row
  return sum / 0.01;
}

const std::string fabric_curves =
    "*DEFINE_CURVE\n5\n0.0,0.0\n0.1,1.0\n0.2,4.0\n*DEFINE_CURVE\n6\n0.0,0.0\n0.05,0.5\n0.06,2.5\n0.07,6.5\n";
std::string fibre_card(const std::string& curves, int cse) {
  return fmt::format("*MAT_FABRIC\n1,1.0,20.0,10.0,,0.0\n3.0,,,{}\n0.0,,,,,14\n\n\n{}\n", cse, curves) +
         fabric_curves;
}
std::string sheet_card(int cse) {
  return fmt::format("*MAT_FABRIC\n1,1.0,30.0,,,0.3\n,,,{}\n\n\n\n", cse);
}

}  // namespace

// Fibres b along y: loading to l = 1.165, back to 1.12, by curves of true stress over ln l.
TEST(Fabrics, StripsFollowTheCurvesOfTheirFibres) {
  for (const int n : {1, 4})
    for (const int elform : {2, 5}) {
      auto s = simulation_of(fabric_square(n, fibre_card("0,5,0,0,6", 1), 2,
                                           "0.0,0.01\n16.0,0.01\n18.0,-0.01\n1e9,-0.01\n", true, elform)
                                 .text(1e9));
      test::start_ledger(*s);
      const auto loading = [](Real l) { return 1 + 30 * (std::log(l) - 0.1); };
      for (const Real l : {1.12, 1.16}) {
        test::run_until(*s, 100 * (l - 1));
        EXPECT_NEAR(fabric_force(*s, n, 1), loading(l), 0.005 * loading(l)) << n << " " << l;
      }
      const Real top = loading(1.165), at_top = 0.06 + 0.01 * (top - 2.5) / 4;
      for (const Real l : {1.155, 1.15, 1.12}) {
        test::run_until(*s, 18 + 100 * (1.16 - l));
        const Real e = std::log(l / 1.165) + at_top;
        const Real stress = e > 0.06 ? 2.5 + 400 * (e - 0.06) : e > 0.05 ? 0.5 + 200 * (e - 0.05) : 10 * e;
        EXPECT_NEAR(fabric_force(*s, n, 1), stress, 0.02 * top) << n << " " << l;
      }
      EXPECT_LT(test::energy_error(*s), 0.01);
    }
}

// Sheared between rails by g: without compression E g/4 along and across the rails, with it G g along.
TEST(Fabrics, WrinklesOfASheetBetweenRailsBearNoCompression) {
  const Real E = 30, g = 0.02;
  for (const int n : {1, 3, 6})
    for (const int cse : {0, 1}) {
      auto s = simulation_of(fabric_square(n, sheet_card(cse), 1, "0.0,0.001\n1e9,0.001\n", false).text(1e9));
      test::run_until(*s, g / 0.001);
      const Real along = cse == 1 ? E * g / 4 : E / 2.6 * g, across = cse == 1 ? E * g / 4 : 0;
      EXPECT_NEAR(fabric_force(*s, n, 0), along, 0.02 * along) << n;
      EXPECT_NEAR(fabric_force(*s, n, 1), across, 0.02 * along) << n;
    }
}

// Pressed by 5 % it bears nothing with CSE 1, and E ln l/(1 - nu^2) between sides that are held without.
TEST(Fabrics, ThatArePressedBuckleAtOnce) {
  for (const int n : {1, 3})
    for (const int cse : {0, 1}) {
      auto s =
          simulation_of(fabric_square(n, sheet_card(cse), 2, "0.0,-0.001\n1e9,-0.001\n", false).text(1e9));
      test::run_until(*s, 50);
      const Real bears = 30 * std::log(0.95) / (1 - 0.09);
      EXPECT_NEAR(fabric_force(*s, n, 1), cse == 1 ? 0 : bears, cse == 1 ? 1e-12 : -0.01 * bears) << n;
    }
}

// A membrane strip that is drawn by 2 % swings as a string: f = sqrt(pull/mass per length)/(2 L); it does not
// bend. The section stays what it is, so that there is less mass on each length.
TEST(Fabrics, MembranesSwingAsStrings) {
  for (const auto& [n, bound] : {std::pair(8, 0.01), {16, 0.003}}) {
    ShellDeck deck;
    deck.plate(1, 0.1, n, 1, 1);
    deck.cards = "*PART\nstrip\n1,1,1\n*SECTION_SHELL\n1,5\n0.01\n*MAT_FABRIC\n1,1.0,100.0,,,0.0\n\n\n\n\n";
    deck.hold(1, "yXYZ", [](const Vec&) { return true; });  // held rotations do not matter to a membrane
    deck.hold(2, "xz", [](const Vec& x) { return x[0] < 1e-9; });
    deck.hold(3, "z", [](const Vec& x) { return x[0] > 1 - 1e-9; });
    deck.node_set(4, [](const Vec& x) { return x[0] > 1 - 1e-9; });
    deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_SET\n4,1,2,1\n*DEFINE_CURVE\n1\n0.0,0.0\n1.0,0.02\n1e9,0.02\n";
    deck.velocity([](const Vec& x) { return Vec(0, 0, 0.005 * std::sin(pi * x[0])); });
    auto s = simulation_of(deck.text(1e9));
    const Index middle = n / 2;
    std::vector<Real> crossings;
    Real before = 0;
    while (crossings.size() < 3 && s->clock().t < 10) {
      s->step(do_nothing);
      const Real z = s->world().nodes.x.vec(middle)[2], t = s->clock().t;
      if (t > 1.2 && before * z < 0) crossings.push_back(t - s->clock().dt_old * z / (z - before));
      before = z;
    }
    ASSERT_EQ(crossings.size(), 3u);
    const Real expected = std::sqrt(100 * std::log(1.02) * 1.02) / (2 * 1.02);
    EXPECT_NEAR(1 / (crossings[2] - crossings[0]), expected, bound * expected) << n;
  }
}

TEST(Fabrics, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  for (const std::string& material : {fibre_card("5,5,5,6,-6,6", 1), sheet_card(1)}) {
    ShellDeck deck;
    deck.plate(1, 1, 12, 12, 1);
    deck.cards = "*PART\nsheet\n1,1,1\n*SECTION_SHELL\n1,5\n0.01\n" + material;
    deck.hold(1, "xyz", [](const Vec& x) { return x[0] < 1e-9; });
    deck.velocity([](const Vec& x) { return Vec(x[0], 0.5 * x[1] * x[0], 0.3 * x[0] * x[1]); });
    test::expect_same_bits(deck.text(100), 60, 25);
  }
}
