// Rigid bodies, joints and what they tell, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "joint_decks.hpp"
#include "output/ascii/ascii.hpp"

using namespace courant;
using test::do_nothing;
using test::JointDeck;
using test::simulation_of;
using test::SolidDeck;

namespace bodies_by_hand_test {
namespace {

const std::string constant = "*DEFINE_CURVE\n3\n0.0,1.0\n9.0,1.0\n";

Sample next_sample(Simulation& s) {
  Sample out;
  s.step([&](World&, const Clock&, const std::string& who) { out = s.sample(who); });
  return out;
}
Vec spin_of(const Simulation& s) {
  Vec L = Vec::Zero();
  for (const RigidBody& b : s.bodies()->bodies())
    if (!b.fixed()) L += b.L + b.m * b.x.cross(b.v);
  return L;
}

}  // namespace

// An arm that is locked to the ground carries m g and, at the joint, m g times the path to its centre; what
// jntforc prints is what the joint tells.
TEST(BodiesByHand, ALockedJointCarriesItsArm) {
  JointDeck deck;
  const int ground = deck.ground(), arm = deck.body({.x = {0.5, 0, 0}, .m = 2});
  deck.joint("LOCKING", ground, arm, {Vec(0, 0, 0), Vec(0, 1, 0), Vec(1, 0, 0)});
  deck.gravity(9.81);
  auto s = simulation_of(deck.text(1));
  for (int k = 0; k < 3; ++k) s->step(do_nothing);
  std::vector<JointForce> joints;
  test::joints_of(*s).report_joints(joints);
  EXPECT_NEAR((joints[0].force - Vec(0, 0, 2 * 9.81)).norm(), 0, 1e-9);
  EXPECT_NEAR((joints[0].moment - Vec(0, -0.5 * 2 * 9.81, 0)).norm(), 0, 1e-9);
}

// Two free bodies with a spring, friction and a damper between them turn against each other.
TEST(BodiesByHand, JointStiffnessKeepsAngularMomentumAndEnergy) {
  JointDeck deck;
  const int a = deck.body({.J = Vec(0.3, 0.2, 0.4).asDiagonal()}),
            b = deck.body({.x = {0.2, 0, 0}, .J = Vec(0.05, 0.08, 0.06).asDiagonal(), .omega = {0, 2, 0}});
  deck.joint("REVOLUTE", a, b, {Vec(0, 0, 0), Vec(0, 1, 0)});
  deck.more =
      fmt::format("*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED\n1,{},{}\n0,9,0,0,10\n0,0,0.5,0.1\n\n", a, b) +
      "*DEFINE_CURVE\n9\n-4.0,-2.0\n4.0,2.0\n*DEFINE_CURVE\n10\n-100.0,-2.0\n100.0,2.0\n";
  auto s = simulation_of(deck.text(2));
  const Vec before = spin_of(*s);
  test::start_ledger(*s);
  const Real initial = s->world().energy.initial;
  Real worst = 0;
  for (int k = 0; k < 60; ++k) {
    for (int i = 0; i < 5; ++i) s->step(do_nothing);
    s->step([&](World& world, const Clock& clock, const std::string&) {
      sample_energy(world, clock);
      worst = std::max(worst, std::abs(world.energy.unexplained()));
    });
  }
  EXPECT_NEAR((spin_of(*s) - before).norm(), 0, 1e-9);
  EXPECT_LT(worst, 2e-3 * initial);  // the spring of friction alone holds 0.1^2/(2 0.5), 6 %
  EXPECT_GT(0.1 * 0.1 / (2 * 0.5), 0.05 * initial);
}

// Driven at a constant rate against a moment: the drive gives the opposite, and its work.
TEST(BodiesByHand, DrivesTellTheMomentAndWorkAgainstALoad) {
  JointDeck deck;
  deck.body({.J = Vec(0.1, 0.2, 0.4).asDiagonal(), .omega = {0, 0, 1}});
  deck.more = "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,7,0,3\n*LOAD_RIGID_BODY\n1,7,3,5.0\n" + constant;
  auto s = simulation_of(deck.text(1) + "");
  Sample last;
  while (s->clock().t < 0.1) last = next_sample(*s);
  ASSERT_EQ(last.boundary_forces.size(), 1u);
  EXPECT_NEAR((last.boundary_forces[0].moment - Vec(0, 0, -5)).norm(), 0, 1e-9);
  EXPECT_NEAR(last.boundary_forces[0].work, -5 * last.t, 0.02 * 5 * last.t);
}

// At rest under a moment: J^-1 M about each axis; displacement and rotation are those since the start.
TEST(BodiesByHand, MotionsOfBodiesAreThoseOfTheClosedForm) {
  JointDeck deck;
  deck.body({.x = {1, 2, 3}, .m = 2, .J = Vec(0.1, 0.2, 0.25).asDiagonal()});
  deck.more = "*LOAD_RIGID_BODY\n1,5,3,0.01\n1,6,3,0.03\n1,2,3,4.0\n" + constant;
  auto s = simulation_of(deck.text(1));
  const RigidBodyMotion first = next_sample(*s).body_motions.at(0);
  EXPECT_NEAR((first.a - Vec(0, 2, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((first.angular_a - Vec(0.1, 0.15, 0)).norm(), 0, 1e-12);
  Sample last;
  while (s->clock().t < 0.2) last = next_sample(*s);
  const RigidBodyMotion& m = last.body_motions.at(0);
  EXPECT_NEAR((m.displacement - Vec(0, last.t * last.t, 0)).norm(), 0, 0.02 * last.t * last.t);
  EXPECT_NEAR((m.rotation - 0.5 * last.t * last.t * Vec(0.1, 0.15, 0)).norm(), 0, 2e-4);
}

// Nodes of a deformable part that a rigid body moves are not damped with it: nothing slows the body in the
// first step, before the rest of the part, which is, pulls at it.
TEST(BodiesByHand, DampingLeavesNodesOfBodiesAlone) {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.4), 1, 1, 2, 1);
  deck.cards =
      "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E7,0.3\n"
      "*CONSTRAINED_NODAL_RIGID_BODY\n9,0,2\n*DAMPING_PART_MASS\n1,3,2.0\n*DEFINE_CURVE\n3\n0.0,50.0\n9.0,50."
      "0\n"
      "*INITIAL_VELOCITY\n1\n1.0\n";
  deck.node_set(1, [](const Vec&) { return true; });
  deck.node_set(2, [](const Vec& x) { return x[2] < 1e-9; });
  auto s = simulation_of(deck.text(1));
  s->step(do_nothing);
  EXPECT_NEAR(s->bodies()->bodies().front().v[0], 1, 1e-12);
  EXPECT_NEAR(s->world().nodes.v.data(0)[11], 1 - 100 * 0.5 * s->clock().dt_old, 1e-12);
}

}  // namespace bodies_by_hand_test
