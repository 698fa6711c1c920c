// *CONSTRAINED_LINEAR_GLOBAL and _LOCAL, and *PERTURBATION_NODE, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "../app/same_after_restart.hpp"
#include "../app/small_scene.hpp"

namespace courant {
namespace {

using test::build_deck;
using test::run;

Vec position(const Simulation& s, Id id) {
  const Nodes& n = s.world().nodes;
  for (Index k = 0; k < n.size(); ++k)
    if (n.id[k] == id) return n.x.vec(k);
  return Vec::Constant(std::nan(""));
}
std::string refusal_of(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(Simulation::build("deck.k", in_memory(text), diagnostics));
  return diagnostics.text();
}

/// Masses of 2 and 3 at nodes 1 and 2, on springs so soft that they do not count, which start at rest; node 3
/// is held. A force of 7 acts on node 1 along x.
std::string masses(const std::string& more, const std::string& held = "0",
                   const std::string& velocity = "0.,0.,0.") {
  return "*KEYWORD\n*NODE\n1,0.,0.,0.," + held + "\n2,1.,0.,0.\n3,0.,5.,0.,7\n" +
         "*ELEMENT_MASS\n1,1,2.\n2,2,3.\n"
         "*ELEMENT_DISCRETE\n1,1,1,3\n2,1,2,3\n*PART\nspring\n1,1,1\n*SECTION_DISCRETE\n1\n*MAT_SPRING_"
         "ELASTIC\n1,1.E-9\n"
         "*DEFINE_CURVE\n1\n0.,7.\n9.,7.\n*LOAD_NODE_POINT\n1,1,1\n*CONTROL_TERMINATION\n1.\n"
         "*CONTROL_TIMESTEP\n0.,0.9,0,0.,0.,2\n*DEFINE_CURVE\n2\n0.,0.001\n1.,0.001\n*INITIAL_VELOCITY_"
         "NODE\n1," +
         velocity + "\n" + more + "*END\n";
}

TEST(LinearConstraint, SharesForcesAsLeversDo) {
  // u1 - 2 u2 = 0: a1 = 4 F/(m2 + 4 m1)
  const auto s = build_deck(masses("*CONSTRAINED_LINEAR_GLOBAL\n1\n1,1,1.\n2,1,-2.\n"), false);
  ASSERT_TRUE(s);
  run(*s, 0.5);
  const Real t = s->clock().t, a1 = 4 * 7.0 / (3 + 4 * 2);
  EXPECT_NEAR(position(*s, 1)[0], 0.5 * a1 * t * t, 0.003 * t * a1);
  EXPECT_NEAR(position(*s, 1)[0] - 2 * (position(*s, 2)[0] - 1), 0, 1e-12);
}

TEST(LinearConstraint, LocalDirections) {
  // (x + y) of node 1 and x of node 2: u1x + u1y - sqrt(2) u2x = 0 along an axis at 45 degrees
  const auto s = build_deck(masses("*DEFINE_COORDINATE_VECTOR\n4,1.,1.,0.,-1.,1.,0.\n"
                                   "*CONSTRAINED_LINEAR_LOCAL\n1\n1,1,4,1.\n2,1,0,-1.\n"),
                            false);
  ASSERT_TRUE(s);
  run(*s, 0.5);
  const Vec u1 = position(*s, 1), u2 = position(*s, 2) - Vec(1, 0, 0);
  EXPECT_NEAR((u1[0] + u1[1]) / std::sqrt(2.0), u2[0], 1e-12);
  // across it node 1 is free: a = F/(sqrt(2) m)
  const Real t = s->clock().t;
  EXPECT_NEAR((u1[0] - u1[1]) / std::sqrt(2.0), 0.5 * 7 / std::sqrt(2.0) / 2 * t * t, 0.01 * t);
}

TEST(LinearConstraint, SeveralThatShareNodesHoldTogether) {
  // u1x = u2x, u1x = u1y: all of 2 + 3 along x, and 2 along y, moves alike
  const auto s = build_deck(
      masses(
          "*CONSTRAINED_LINEAR_GLOBAL\n1\n1,1,1.\n2,1,-1.\n*CONSTRAINED_LINEAR_GLOBAL\n2\n1,1,1.\n1,2,-1.\n"),
      false);
  ASSERT_TRUE(s);
  run(*s, 0.5);
  const Real t = s->clock().t;
  EXPECT_NEAR(position(*s, 1)[0], 0.5 * 7.0 / 7 * t * t, 0.003 * t);
  EXPECT_NEAR(position(*s, 1)[0], position(*s, 1)[1], 1e-12);
  EXPECT_NEAR(position(*s, 1)[0], position(*s, 2)[0] - 1, 1e-12);
}

TEST(LinearConstraint, HeldNodesCountAsAtRest) {
  const auto s = build_deck(masses("*CONSTRAINED_LINEAR_GLOBAL\n1\n1,1,1.\n2,1,-2.\n", "1"), false);
  ASSERT_TRUE(s);
  run(*s, 0.5);
  EXPECT_NEAR(position(*s, 2)[0], 1, 1e-9);
}

TEST(LinearConstraint, VelocitiesAtTheStartAreMadeToFit) {
  Diagnostics diagnostics;
  const auto s = Simulation::build(
      "deck.k", in_memory(masses("*CONSTRAINED_LINEAR_GLOBAL\n1\n1,1,1.\n2,1,-1.\n", "0", "5.,0.,0.")),
      diagnostics);
  ASSERT_TRUE(s) << diagnostics.text();
  EXPECT_NE(diagnostics.text().find("velocities at the start do not fit: 15 of 25 of kinetic energy"),
            std::string::npos)
      << diagnostics.text();
  for (Index k = 0; k < s->world().nodes.size(); ++k)
    if (s->world().nodes.id[k] < 3) EXPECT_NEAR(s->world().nodes.v.vec(k)[0], 2, 1e-12);  // momentum stays
}

TEST(LinearConstraint, RefusesByName) {
  const std::string one = "*CONSTRAINED_LINEAR_GLOBAL\n1\n1,1,1.\n2,1,-1.\n";
  EXPECT_NE(refusal_of(masses(one + one)).find("it follows from others, or contradicts them"),
            std::string::npos);
  EXPECT_NE(
      refusal_of(masses("*CONSTRAINED_LINEAR_GLOBAL\n1\n1,1,1.\n9,1,-1.\n")).find("node 9 does not exist"),
      std::string::npos);
  EXPECT_NE(
      refusal_of(masses("*CONSTRAINED_LINEAR_GLOBAL\n1\n1,4,1.\n2,4,-1.\n")).find("node 1 does not turn"),
      std::string::npos);
  EXPECT_NE(refusal_of(masses("*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,0,1\n" + one)).find("node 2 is driven"),
            std::string::npos);
}

/// A sheet of 2 x 1 shells.
std::string sheet(const std::string& more) {
  return "*KEYWORD\n*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,2.,0.,0.\n4,0.,1.,0.\n5,1.,1.,0.\n6,2.,1.,0.\n"
         "*ELEMENT_SHELL\n1,1,1,2,5,4\n2,1,2,3,6,5\n*PART\nsheet\n1,1,1\n*SECTION_SHELL\n1,2\n0.01\n"
         "*MAT_ELASTIC\n1,1000.,1.E9,0.3\n*CONTROL_TERMINATION\n1.\n" +
         more + "*END\n";
}

TEST(PerturbationOfNodes, IsASumOfWaves) {
  const auto s = build_deck(sheet("*PERTURBATION_NODE\n1,0,2.,3\n0.01,8.,1.,4.,0.\n"), false);
  ASSERT_TRUE(s);
  for (Id id = 1; id <= 6; ++id) {
    const Vec x = position(*s, id);
    EXPECT_NEAR(x[2], 2 * 0.01 * (std::sin(2 * pi * (x[0] + 1) / 8) + std::sin(2 * pi * x[1] / 4)), 1e-15);
  }
}

TEST(PerturbationOfNodes, OfASetAlongLocalAxesAndTwice) {
  // system 3 has its x along y; both waves are of the coordinates before
  const std::string system = "*DEFINE_COORDINATE_VECTOR\n3,0.,1.,0.,-1.,0.,0.\n*SET_NODE\n1\n2,3\n";
  const auto s = build_deck(sheet(system + "*PERTURBATION_NODE\n1,1,1.,1,1,3\n0.1,0.,0.,8.,0.\n"
                                           "*PERTURBATION_NODE\n1,1,1.,1,1,3\n0.2,0.,0.,8.,0.\n"),
                            false);
  ASSERT_TRUE(s);
  EXPECT_NEAR((position(*s, 2) - Vec(1, 0.3 * std::sin(2 * pi * -1 / 8.0), 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((position(*s, 3) - Vec(2, 0.3 * std::sin(2 * pi * -2 / 8.0), 0)).norm(), 0, 1e-15);
  EXPECT_EQ(position(*s, 5), Vec(1, 1, 0));
}

TEST(PerturbationOfNodes, OtherKindsAreRefused) {
  EXPECT_NE(refusal_of(sheet("*PERTURBATION_NODE\n8,0,1.,3\n")).find("TYPE"), std::string::npos);
}

TEST(LinearConstraint, SameBitsAfterARestart) {
  test::expect_same_after_restart(masses("*CONSTRAINED_LINEAR_GLOBAL\n1\n1,1,1.\n2,1,-2.\n"), 50, 50);
}

}  // namespace
}  // namespace courant
