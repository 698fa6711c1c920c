// Contact of nodes with faces at its ends: rigid blocks of many nodes with damping, tools that yield
// nowhere, soft floors before stiff walls.
#include <gtest/gtest.h>

#include "shell_decks.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

namespace {

/// A rigid block of n x n solids over a held rigid plate, at 1 m/s downwards: free along z, or driven.
SolidDeck block_over_plate(int n, const std::string& motion) {
  SolidDeck deck;
  deck.block(Vec(0.02, 0.02, 0.02 / n), n, n, 1, 1,
             [](const Vec& x) { return Vec(x + Vec(0.01, 0.01, 0.002)); });
  deck.cards =
      "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_RIGID\n1,2000.0,1.0E8,0.3\n1,0,7\n"
      "*PART\nplate\n2,2,2\n*SECTION_SHELL\n2,2\n0.002,0.002,0.002,0.002\n*MAT_RIGID\n2,2000.0,1.0E8,0.3\n1,"
      "7,7\n"
      "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0,0,0,0\n0.0,0.0,0.0,0.0,20.0\n\n" +
      motion;
  const std::size_t first = deck.nodes.size() + 1;
  for (const Real y : {0.0, 0.04})
    for (const Real x : {0.0, 0.04}) deck.nodes.emplace_back(x, y, 0);
  deck.particles =
      fmt::format("*ELEMENT_SHELL\n100001,2,{},{},{},{}\n", first, first + 1, first + 3, first + 2);
  return deck;
}

}  // namespace

// Each node damps by its own mass: by that of its body, as often as there are nodes, it made fifteen times
// the energy that came.
TEST(ContactExtremes, DampingTakesEnergyFromRigidBlocksOfAnyMesh) {
  std::vector<Real> left;
  for (const int n : {4, 20, 40}) {
    auto s =
        simulation_of(block_over_plate(n, "*INITIAL_VELOCITY_GENERATION\n1,2,0.0,0.0,0.0,-1.0\n\n").text(1));
    test::start_ledger(*s);
    const Real before = s->world().energy.kinetic;
    while (s->clock().t < 0.003) s->step(do_nothing);
    test::energy_error_of_a_step(*s);
    left.push_back(s->world().energy.kinetic / before);
    EXPECT_LT(left.back(), 0.6) << n;
    EXPECT_GT(left.back(), 0.3) << n;
  }
  EXPECT_NEAR(left[1], left[2], 0.05);
}

TEST(ContactExtremes, ADrivenToolOnAFixedDieWithDampingRuns) {
  auto s = simulation_of(
      block_over_plate(
          1, "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,3,0,1,-1.0\n*DEFINE_CURVE\n1\n0.0,1.0\n1.0,1.0\n")
          .text(1));
  while (s->clock().t < 0.0015) s->step(do_nothing);
  EXPECT_NEAR(s->world().nodes.v.vec(0)[2], -1, 1e-12);
}

// A point slides on a soft floor into a stiff wall: the step is that of the wall before it is there.
TEST(ContactExtremes, WallsAreToldOfWhileAFloorIsTouched) {
  test::ShellDeck deck;
  deck.plate(0.4, 0.2, 2, 1, 1, [](const Vec& x) { return Vec(x - Vec(0.2, 0.1, 0)); });
  deck.plate(0.2, 0.2, 1, 1, 2, [](const Vec& x) { return Vec(0.2, x[1] - 0.1, x[0] - 0.1); });
  for (const int part : {1, 2})
    deck.cards += fmt::format("*PART\nwall\n{0},1,{0}\n*MAT_RIGID\n{0},2000.0,{1},0.3\n1,7,7\n", part,
                              part == 1 ? "1.0E4" : "1.0E11");
  deck.cards += "*SECTION_SHELL\n1,2\n0.002,0.002,0.002,0.002\n";
  deck.nodes.emplace_back(0.13123, 0.05, 0.00099);
  deck.node_set(9, [](const Vec& x) { return x[1] > 0.04 && x[1] < 0.06; });
  deck.cards += fmt::format(
      "*ELEMENT_MASS\n1,{0},1.0E-6\n*INITIAL_VELOCITY_NODE\n{0},20.0,0.0,0.0\n*SET_PART_LIST\n1\n1,2\n"
      "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n9,1,4,2\n\n\n",
      deck.nodes.size());
  auto s = simulation_of(deck.text(1));
  test::start_ledger(*s);
  const Real before = s->world().energy.kinetic;
  while (s->clock().t < 0.005) s->step(do_nothing);
  test::energy_error_of_a_step(*s);
  const Vec v = s->world().nodes.v.vec(s->world().nodes.size() - 1);
  EXPECT_LT(v[0], 0) << "came back";
  EXPECT_NEAR(s->world().energy.kinetic / before, 1, 0.05);
}

// Rigid cubes that fall on a held block bounce on their corners at random times of a step, which is first a
// thousandth of the run: by the masses of their nodes they lost a few percent of each bounce, and with steps
// that led behind the surface a quarter of the first.
TEST(ContactExtremes, RigidCubesBounceOnTheirCornersWithoutLosses) {
  for (const Real angle : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const Matrix R = Eigen::AngleAxisd(angle, Vec(2, -1, 0.3).normalized()).toRotationMatrix();
    SolidDeck deck;
    deck.block(Vec(0.1, 0.1, 0.1), 1, 1, 1, 1,
               [&](const Vec& x) { return Vec(R * (x - Vec::Constant(0.05)) + Vec(0, 0, 0.2)); });
    deck.block(Vec(1, 1, 0.1), 1, 1, 1, 2, [](const Vec& x) { return Vec(x - Vec(0.5, 0.5, 0.1)); });
    deck.cards =
        "*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_RIGID\n1,7850.0,2.1E11,0.3\n"
        "*PART\nfloor\n2,1,2\n*MAT_RIGID\n2,7850.0,2.1E11,0.3\n1,7,7\n"
        "*LOAD_BODY_Z\n9,9.81\n*DEFINE_CURVE\n9\n0.0,1.0\n100.0,1.0\n"
        "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n1,2,3,3\n\n\n";
    auto s = simulation_of(deck.text(2));
    Real height = 0, most = 0;  // of the mean energy after bounces
    while (s->clock().t < 1) {
      s->step([&](World& world, const Clock& clock, const std::string&) {
        sample_energy(world, clock);
        const EnergyLedger& e = world.energy;
        if (e.contact == 0) most = std::max(most, std::abs(e.unexplained()));
        height = std::max(height, e.kinetic);
      });
    }
    EXPECT_GT(height, 5) << angle;  // 7.85 kg, 0.1 m
    EXPECT_LT(most, 0.001 * height) << angle << " " << most;
  }
}

// The same flat, and a plate of many shells: all nodes come at once, so each position yields by all springs.
// One spring for each made 7 % of the energy, the masses of nodes lost 3 to 38 %. A single shell is held by
// springs of two kinds, its own and those of the floor's nodes.
TEST(ContactExtremes, RigidBodiesThatLandFlatBounceWithoutLosses) {
  for (const int n : {1, 4, 10})
    for (const Real gap : {0.00203, 0.00231}) {
      test::ShellDeck deck;
      deck.plate(0.2, 0.2, n, n, 1, [&](const Vec& x) { return Vec(x + Vec(0.01, 0.02, gap)); });
      deck.plate(0.3, 0.3, 3, 3, 2, [](const Vec& x) { return Vec(x - Vec(0.04, 0.04, 0)); });
      deck.part(1, 0.002, "*MAT_RIGID\n1,7800.0,2.0E11,0.3\n0,0,0\n");
      deck.part(2, 0.002, "*MAT_RIGID\n2,7800.0,2.0E11,0.3\n1,7,7\n");
      deck.cards +=
          "*INITIAL_VELOCITY_GENERATION\n1,2,0.0,0.0,0.0,-5.0\n\n*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n\n\n";
      auto s = simulation_of(deck.text(1));
      test::start_ledger(*s);
      while (s->clock().t < 0.0003) s->step(do_nothing);
      const Real lost = test::energy_error_of_a_step(*s);
      EXPECT_GT(s->world().nodes.v.vec(0)[2], 4) << n;
      EXPECT_LT(std::abs(lost), n == 1 ? 0.02 : 5e-4) << n << " " << gap;
    }
}
