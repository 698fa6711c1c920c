// Rigid bodies in a dynamic relaxation and in the run behind it.
#include <gtest/gtest.h>

#include "joint_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::JointDeck;
using test::simulation_of;

namespace relaxed_bodies_test {
namespace {

std::string spinning_body() {
  JointDeck deck;
  deck.body({.m = 2, .J = Vec(0.1, 0.2, 0.25).asDiagonal(), .v = {1, 2, 3}, .omega = {4, -5, 6}});
  deck.curve(3, "0.0,1.0\n9.0,1.0\n");
  deck.more += "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,1,0,3,2.0\n*LOAD_BODY_X\n3,7.0\n";
  return deck.text(1);
}

}  // namespace

// Slowed bodies go on, and turn, at that part of their velocities: omega is still that of L.
TEST(RelaxedBodies, AreSlowedInAllTheirMotion) {
  auto s = simulation_of(spinning_body());
  const RigidBody before = s->bodies()->bodies().front();
  s->slow_bodies(0.5);
  const RigidBody& b = s->bodies()->bodies().front();
  EXPECT_NEAR((b.v - 0.5 * before.v).norm(), 0, 1e-15);
  EXPECT_NEAR((b.omega - 0.5 * before.omega).norm(), 0, 1e-15);
  EXPECT_NEAR((b.omega_of(b.q) - 0.5 * before.omega).norm(), 0, 1e-14);
  EXPECT_NEAR(s->bodies()->kinetic_energy(), 0.25 * before.kinetic_energy(), 1e-13);
  s->slow_down(0);
  EXPECT_EQ(s->bodies()->kinetic_energy(), 0);
}

// The run starts where the relaxation ended, at the velocities of the deck, with no work done.
TEST(RelaxedBodies, StartAtTheVelocitiesOfTheDeckWhereTheyCameToRest) {
  auto relaxed = simulation_of(spinning_body()), run = simulation_of(spinning_body());
  const Vec v = run->bodies()->bodies().front().v, omega = run->bodies()->bodies().front().omega;
  while (relaxed->clock().t < 0.1) relaxed->step(do_nothing);
  const RigidBody end = relaxed->bodies()->bodies().front();
  ASSERT_NE(end.drive_work, 0);
  run->start_from(*relaxed);
  const RigidBody& b = run->bodies()->bodies().front();
  EXPECT_NEAR((b.x - end.x).norm(), 0, 1e-15);
  EXPECT_NEAR(b.q.angularDistance(end.q), 0, 1e-12);
  EXPECT_NEAR((b.v - v).norm(), 0, 1e-14);
  EXPECT_NEAR((b.omega - omega).norm(), 0, 1e-13);
  EXPECT_EQ(b.drive_work, 0);
}

}  // namespace relaxed_bodies_test
