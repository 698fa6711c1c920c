// Concrete by a cap surface, voids, tables and damage by the state of stress: one-element decks as users
// write them.
#include <gtest/gtest.h>

#include <cmath>

#include "cube_decks.hpp"
#include "pressure_decks.hpp"
#include "same_bits_of_material.hpp"
#include "shell_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::driven_cube;
using test::ShellDeck;
using test::simulation_of;

namespace concrete_and_damage_test {

namespace {

/// E 947.4, strength in tension about 0.2; fracture energies 0.02, 2.
std::string concrete_card(int rates, Real erode) {
  return fmt::format(
      "*MAT_CSCM\n1,1.0,1,0.0,{},{}\n0.0\n400.0,500.0,0.9,0.3,0.65,0.6\n0.74735,0.0,0.17,2.0,0.66,0.0,0.16,2."
      "0\n5.0,5.0,0."
      "05,0.01,1e-4\n100.0,2.0,0.1,0.02,0.02,5.0,1.0\n0.02,0.78,0.02,0.48,1.0,1.0,1.0,1.0\n",
      rates, erode);
}
const std::string bar_of_1 = "1,1.0,1000.0,0.3";
const std::string work_card =
    "*MAT_MODIFIED_JOHNSON_COOK\n" + bar_of_1 + "\n0.01,,,,0,1\n1.0,0.0,1.0\n\n1.0,0.1\n\n";
const std::string void_card =
    "*MAT_GURSON\n" + bar_of_1 +
    ",1.0,8.0,1.5,1.0\n0.05,0.01,0.3,0.1,0.04,0.0,1,0.0\n\n\n0.5,2.0,,,0.15,0.2\n0,0,1.0\n";
const std::string table_card =
    "*MAT_TABULATED_JOHNSON_COOK\n" + bar_of_1 +
    ",1.0,300.0,0.9\n7,0,9,0,0,11\n\n*DEFINE_CURVE\n7\n0.0,1.0\n1.0,1.5\n*DEFINE_CURVE\n9\n-0."
    "4,0.1\n0.4,0.5\n*DEFINE_CURVE\n11\n0.1,1.5\n1.0,1.0\n";
/// Failure strain 0.4 - 0.3 triaxiality, half of it in elements of size 2.
const std::string gissmo_card = "*MAT_PIECEWISE_LINEAR_PLASTICITY\n" + bar_of_1 +
                                ",1.0\n\n\n\n*MAT_ADD_DAMAGE_GISSMO\n1,,1,,1\n9,0.0,1.0,0.5,1.0,11\n\n*"
                                "DEFINE_CURVE\n9\n-1.0,0.7\n1.0,0.1\n*DEFINE_"
                                "CURVE\n11\n1.0,1.0\n2.0,0.5\n";
const std::string sheet_card =
    "*MAT_BARLAT_YLD2000\n1,1.0,1000.0,0.3\n1.2,0.01,0.1,0,0,1,8.0\n0.4865,1.3783,0.7536,1.0246,1.0363,0."
    "9036,1.2321,1."
    "4858\n0\n\n\n";

/// Of the elements at x = 1 of a cube of n^3.
Real tension_of(Simulation& s, int n) {
  const ElementGroup& group = *s.world().groups[0];
  Real sum = 0;
  for (Index e = n - 1; e < group.size(); e += n)
    for (const int corner : {1, 2, 5, 6}) sum += group.corner_force->data(3 * corner)[e];
  return std::abs(sum);
}
std::int64_t deleted(Simulation& s) {
  return s.world().counters["deleted_elements"];
}
/// Strain along the bar at which its element goes.
Real strain_at_failure(const std::string& card, Real velocity) {
  auto s = simulation_of(driven_cube(1, card, fmt::format("0.0,{0}\n1e9,{0}\n", velocity), false).text(1e9));
  while (deleted(*s) == 0 && s->clock().t < 1 / std::abs(velocity)) s->step(do_nothing);
  return std::log(1 + velocity * s->clock().t);
}

}  // namespace

// Torn cubes: the energy is that of the peak and the fracture energy over the area, of one element and of 2 x
// 2 x 2.
TEST(ConcreteAndDamage, ConcreteTakesItsFractureEnergy) {
  const Real K = 500, G = 400, E = 9 * K * G / (3 * K + G), root3 = std::sqrt(3.0);
  Real low = 0, high = 1;
  for (int k = 0; k < 60; ++k) {  // 2/3 f = F(-f)/root3
    const Real f = 0.5 * (low + high);
    (2 * f / 3 > (0.9 - 0.65 * std::exp(0.6 * f) - 0.3 * f) / root3 ? high : low) = f;
  }
  for (const int n : {1, 2}) {
    auto s = simulation_of(driven_cube(n, concrete_card(0, 0), "0.0,0.002\n1e9,0.002\n", false).text(1e9));
    test::start_ledger(*s);
    Real top = 0;
    while (s->clock().t < 500) {
      s->step(do_nothing);
      top = std::max(top, tension_of(*s, n));
    }
    EXPECT_NEAR(top, low, 0.03 * low);
    sample_energy(s->world(), s->clock());
    // of two rows one tears, after the other has begun to
    const Real energy = s->world().energy.internal - low * low / (2 * E);
    EXPECT_NEAR(energy, 0.02, n == 1 ? 0.03 * 0.02 : 0.2 * 0.02) << n;
    EXPECT_LT(test::energy_error(*s), 0.01);
  }
}

// Damaged beyond 0.99 and longer than ERODE - 1 an element goes.
TEST(ConcreteAndDamage, ConcreteErodes) {
  EXPECT_NEAR(strain_at_failure(concrete_card(0, 1.65), 0.002), 0.65, 0.01);
}

// Fracture at the work of the yield stress 1 over the strain; at the failure strain of tension by tables, and
// by GISSMO.
TEST(ConcreteAndDamage, BarsTearAtTheirStrains) {
  EXPECT_NEAR(strain_at_failure(work_card, 0.002), 0.1 + 0.001, 0.002);
  // LCF at p/q -1/3: 0.1 + 0.4 (1/15)/0.8, elements of size 1
  EXPECT_NEAR(strain_at_failure(table_card, 0.002), 0.1 + 0.4 / 12 + 0.001, 0.003);
  EXPECT_NEAR(strain_at_failure(gissmo_card, 0.002), 0.3 + 0.0005, 0.006);
  const Real of_voids = strain_at_failure(void_card, 0.002);
  EXPECT_GT(of_voids, 0.3);
  EXPECT_LT(of_voids, 1);
}

// Sheets of one element, of 1 x 1 and of 2 x 2: the failure strain of the second is half of that of the
// first.
TEST(ConcreteAndDamage, GissmoKnowsTheSizeOfShells) {
  for (const auto& [size, strain] : {std::pair{1.0, 0.3}, {2.0, 0.15}}) {
    ShellDeck deck;
    deck.plate(size, size, 1, 1, 1);
    deck.part(1, 0.01, gissmo_card, 3);
    deck.hold(1, "x", [](const Vec& x) { return x[0] < 1e-9; });
    deck.hold(2, "y", [](const Vec& x) { return x[1] < 1e-9; });
    deck.node_set(3, [&, size = size](const Vec& x) { return x[0] > size - 1e-9; });
    deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,1\n*DEFINE_CURVE\n1\n0.0,0.002\n1e9,0.002\n";
    auto s = simulation_of(deck.text(1e9));
    while (deleted(*s) == 0 && s->clock().t < 1000) s->step(do_nothing);
    EXPECT_NEAR(std::log(1 + 0.002 * s->clock().t / size), strain, 0.02 * strain) << size;
  }
}

TEST(ConcreteAndDamage, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  for (const std::string& material : {concrete_card(1, 1.01), work_card, void_card, table_card, gissmo_card})
    test::expect_same_bits_of_block(material);
  for (const std::string& material : {sheet_card, gissmo_card, void_card, table_card})
    test::expect_same_bits_of_sheet(material);
}

}  // namespace concrete_and_damage_test
