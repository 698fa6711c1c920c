// Joints where steps are short, masses far apart, places far away, and where they cannot hold.
#include <gtest/gtest.h>

#include <cmath>

#include "base/run_error.hpp"
#include "joint_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::height_energy;
using test::JointDeck;
using test::joints_of;
using test::kinetic;
using test::largest_gap;
using test::simulation_of;

// A body hangs in a hinge, another one is released from level: m g, and m g (1 - m d^2/(J + m d^2)).
TEST(JointLimits, ForcesAreRightHoweverShortTheStepIs) {
  const Real m = 2, d = 0.5, J = 0.2, g = 9.81;
  for (const Real end : {1e-2, 1e-4, 1e-5})
    for (const Real far : {0.0, 5.0}) {
      JointDeck deck;
      const Vec place(far, 0, 0), axis(0, 1, 0);
      const int ground = deck.body({.x = place, .con1 = 7, .con2 = 7});
      const int hangs = deck.body({.x = place - d * Vec::UnitZ(), .m = m, .J = J * Matrix::Identity()});
      const int level = deck.body({.x = place + d * Vec::UnitX(), .m = m, .J = J * Matrix::Identity()});
      deck.joint("REVOLUTE", ground, hangs, {place, place + axis});
      deck.joint("REVOLUTE", ground, level, {place, place + axis});
      deck.gravity(g);
      const Real dt = 1e-3 * end;  // what bodies alone take
      auto s = simulation_of(deck.text(end));
      const Real expected[] = {m * g, m * g * (1 - m * d * d / (J + m * d * d))};
      for (int k = 0; k < 300; ++k) {
        s->step(do_nothing);
        ASSERT_NEAR(s->clock().dt_old, dt, 1e-6 * dt);
        std::vector<JointForce> forces;
        joints_of(*s).report_joints(forces);
        for (std::size_t j = 0; j < 2; ++j)
          ASSERT_NEAR(forces[j].force[2], expected[j], 1e-3 * expected[j]) << dt << " " << far << " " << k;
      }
      EXPECT_LT(largest_gap(*s), 1e-12);
    }
}

// Five rods of 1 kg carry a million times their mass, released from level.
TEST(JointLimits, LightLinksCarryAHeavyBob) {
  const Real l = 0.2, m = 1, heavy = 1e6, g = 9.81;
  JointDeck deck;
  int last = deck.ground();
  const int links = 5;
  const auto hinge = [&](int a, int b, Real x) {
    deck.joint("REVOLUTE", a, b, {Vec(x, 0, 0), Vec(x, 1, 0)});
  };
  for (int k = 0; k < links; ++k) {
    const Real J = m * l * l / 12;
    const int link = deck.body({.x = {(k + 0.5) * l, 0, 0}, .m = m, .J = Vec(0.3 * J, J, J).asDiagonal()});
    hinge(last, link, k * l), last = link;
  }
  const Real end = links * l;
  const int bob = deck.body({.x = {end + 0.1, 0, 0}, .m = heavy, .J = 0.01 * heavy * Matrix::Identity()});
  hinge(last, bob, end);
  deck.gravity(g);
  auto s = simulation_of(deck.text(0.5));
  const RigidBody& b = s->bodies()->bodies().back();
  Real before = kinetic(*s), worst = 0;
  while (s->clock().t < 0.5) {
    const Real height = height_energy(*s, g);
    s->step(do_nothing);
    if (before > 0) worst = std::max(worst, std::abs(0.5 * (before + kinetic(*s)) + height));
    before = kinetic(*s);
    ASSERT_LT(largest_gap(*s), 1e-10) << s->clock().t;
  }
  EXPECT_LT(worst, 1e-3 * heavy * g * end);
  EXPECT_LT(b.x[2], -0.9) << "it fell";
}

// A door on a hinge swings on a spring between its edge and a fixed body: w^2 = k r^2/J about the hinge.
TEST(JointLimits, SpringsActOnBodiesWithJoints) {
  const Real m = 2, d = 0.5, J = 0.2, r = 1, k = 300, start = 0.01;
  JointDeck deck;
  const int ground = deck.ground();
  const int door = deck.body(
      {.x = {d, 0, 0}, .m = m, .J = J * Matrix::Identity(), .v = {0, d * start, 0}, .omega = {0, 0, start}});
  deck.joint("REVOLUTE", ground, door, {Vec(0, 0, 0), Vec(0, 0, 1)});
  const int ends[] = {++deck.node, ++deck.node};
  deck.nodes += fmt::format("{},{},0,0\n{},{},1,0\n", ends[0], r, ends[1], r);
  deck.extra += fmt::format("{},{}\n{},{}\n", door, ends[0], ground, ends[1]);
  deck.more += fmt::format(
      "*PART\nspring\n9,9,9\n*SECTION_DISCRETE\n9,0\n\n*MAT_SPRING_ELASTIC\n9,{}\n*ELEMENT_DISCRETE\n9,9,{},{"
      "}\n",
      k, ends[0], ends[1]);
  const Real period = 2 * std::acos(-1.0) * std::sqrt((J + m * d * d) / (k * r * r));
  auto s = simulation_of(deck.text(period));
  const RigidBody& b = s->bodies()->bodies()[1];
  while (s->clock().t < 0.25 * period) s->step(do_nothing);
  EXPECT_NEAR(b.omega[2], 0, 0.02 * start);
  while (s->clock().t < 0.5 * period) s->step(do_nothing);
  EXPECT_NEAR(b.omega[2], -start, 0.002 * start);
}

// A door whose hinges are askew by what the digits of a deck leave goes on turning.
TEST(JointLimits, TwoHingesALittleAskewDoNotBrakeADoor) {
  for (const Real slight : {1e-7, 1e-6}) {
    JointDeck deck;
    const int ground = deck.ground();
    const int door = deck.body(
        {.x = {0.4, 0, 1}, .m = 20, .J = Vec(7, 8, 1.2).asDiagonal(), .v = {0, 0.4, 0}, .omega = {0, 0, 1}});
    deck.joint("REVOLUTE", ground, door, {Vec(0, 0, 0.2), Vec(0, 0, 0.3)});
    deck.joint("REVOLUTE", ground, door, {Vec(0, slight, 1.8), Vec(0, slight, 1.9)});
    deck.gravity(9.81);
    auto s = simulation_of(deck.text(6));
    while (s->clock().t < 6) s->step(do_nothing);
    EXPECT_NEAR(s->bodies()->bodies().back().omega[2], 1, 1e-4) << slight;
    EXPECT_LT(largest_gap(*s), 3 * slight);
  }
}

// Two bodies are driven apart: their exact joint yields where it is open by no more than its own size
// allows, wherever the scene stands; one that may become a spring, by a twentieth of it.
TEST(JointLimits, WhatDrivesAJointApartStopsTheRun) {
  for (const Real far : {0.0, 100.0, 10000.0})
    for (const bool exact : {true, false}) {
      JointDeck deck;
      const Matrix J = 0.02 * Matrix::Identity();
      const int a = deck.body({.x = {far, 0, 0}, .m = 2, .J = J});
      const int b = deck.body({.x = {far + 0.2, 0, 0}, .m = 2, .J = J});
      deck.joint("SPHERICAL", a, b, {Vec(far + 0.1, 0, 0)});
      deck.more = fmt::format(
          "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{},1,0,7\n{},1,0,8\n*DEFINE_CURVE\n7\n0.,0.\n9.,0.\n"
          "*DEFINE_CURVE\n8\n0.,0.\n9.,.9\n{}",
          a, b, exact ? "*CONTROL_RIGID\n1\n" : "");
      auto s = simulation_of(deck.text(1));
      EXPECT_THROW(while (s->clock().t < 1) s->step(do_nothing), RunError) << far;
      const Real size = 0.1 + std::sqrt(0.03), open = s->bodies()->bodies()[1].x[0] - far - 0.2;
      EXPECT_LT(open, (exact ? 1e-4 : 0.05) * size) << far;
      EXPECT_GT(open, (exact ? 0.5e-4 : 0.045) * size) << far;
      auto& maxima = s->world().maxima;
      EXPECT_GT(maxima["joint_gap_share"], 1e-5) << "the verdict tells of it before";
      EXPECT_EQ(maxima.contains("joint_spring_gap_share"), !exact);
    }
}

// A body that is driven at 10 from the start is locked to one that moves with 10: nothing is lost. One at
// rest is taken along.
TEST(JointLimits, WhatIsDrivenKeepsItsVelocityAtTheStart) {
  for (const Real second : {10.0, 0.0}) {
    JointDeck deck;
    const Matrix J = 0.02 * Matrix::Identity();
    const int a = deck.body({.m = 2, .J = J}),
              b = deck.body({.x = {0.2, 0, 0}, .m = 2, .J = J, .v = {second, 0, 0}});
    deck.joint("LOCKING", a, b, {Vec(0.1, 0, 0), Vec(0.3, 0, 0), Vec(0.1, 0.1, 0)});
    deck.more =
        fmt::format("*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{},1,0,7\n*DEFINE_CURVE\n7\n0.,10.\n9.,10.\n", a);
    auto s = simulation_of(deck.text(0.1));
    for (const RigidBody& body : s->bodies()->bodies()) EXPECT_NEAR(body.v.x(), 10, 1e-9) << second;
    s->step(do_nothing);
    std::vector<JointForce> forces;
    joints_of(*s).report_joints(forces);
    EXPECT_NEAR(forces[0].force.norm(), 0, 1e-3) << second;
    EXPECT_LT(largest_gap(*s), 1e-12);
  }
}
