// *BOUNDARY_PRESCRIBED_MOTION_RIGID about axes of bodies that may turn about others, too, and _LOCAL.
#include <gtest/gtest.h>

#include "joint_decks.hpp"
#include "rigid/bodies/rigid.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::expect_same_bits;
using test::simulation_of;
using test::SolidDeck;
using test::start_ledger;

namespace {

const Vec driven_inertia(2.08, 1.6, 0.8);  // of a brick of 48 with edges 0.2, 0.4, 0.6

/// A rigid brick with axes of its own along the edges, or none; `step`: the longest.
SolidDeck driven_brick(bool axes, const Vec& omega, Real step, const std::string& cards) {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.4, 0.6), 1, 1, 1, 1);
  deck.cards =
      "*PART\nbrick\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_RIGID\n1,1000.0,1.0E9,0.3\n0\n" +
      std::string(axes ? "1.0,0.0,0.0,0.0,1.0,0.0" : "0") +
      fmt::format("\n*INITIAL_VELOCITY_RIGID_BODY\n1,0,0,0,{},{},{}\n", omega[0], omega[1], omega[2]) +
      fmt::format("*CONTROL_TIMESTEP\n0.0,1.0,0,0.0,0.0,9\n*DEFINE_CURVE\n9\n0.0,{0}\n100.0,{0}\n", step) +
      cards;
  return deck;
}
std::string driven_by(const char* option, int dof, Real velocity) {  // a factor of 0 would be one of 1
  return fmt::format("*BOUNDARY_PRESCRIBED_MOTION_RIGID{}\n1,{},0,{}\n*DEFINE_CURVE\n{}\n0.0,{}\n100.0,{}\n",
                     option, dof, 10 + dof, 10 + dof, velocity, velocity);
}
const RigidBody& brick_of(const Simulation& s) {
  return s.bodies()->bodies().front();
}

}  // namespace

// All three rotations are driven: the body turns as told, and the moment is omega x J omega.
TEST(DrivenTurns, ThreeAtOnceTurnTheBodyAsTold) {
  const Vec omega(1, 2, -0.5);
  auto s = simulation_of(
      driven_brick(false, omega, 1e-3,
                   driven_by("", 5, omega[0]) + driven_by("", 6, omega[1]) + driven_by("", 7, omega[2]))
          .text(10));
  start_ledger(*s);
  while (s->clock().t < 2) s->step(do_nothing);
  const RigidBody& b = brick_of(*s);
  const Matrix turn = Eigen::AngleAxisd(omega.norm() * s->clock().t, omega.normalized()).toRotationMatrix();
  EXPECT_NEAR((b.q.toRotationMatrix() - turn).norm(), 0, 1e-10);
  EXPECT_NEAR((b.omega - omega).norm(), 0, 1e-12);
  EXPECT_LT(test::energy_error(*s), 1e-5);
  const Matrix J = turn * driven_inertia.asDiagonal() * turn.transpose();
  std::vector<BoundaryForce> forces;
  std::string who;
  s->evaluate(who);
  s->bodies()->report_forces(s->world(), s->clock(), forces);
  const Vec expected = omega.cross(J * omega);
  EXPECT_NEAR((forces.at(0).moment - expected).norm(), 0, 3e-3 * expected.norm());
}

// Driven about a global axis alone: the moment has no part across it.
TEST(DrivenTurns, OneLeavesTheOthersFree) {
  const Vec start(1, 0.3, 0.2);
  auto s = simulation_of(driven_brick(false, start, 1e-3, driven_by("", 5, 3)).text(10));
  std::string who;
  s->evaluate(who);
  const Vec L = brick_of(*s).L;
  start_ledger(*s);
  while (s->clock().t < 3) {
    s->step(do_nothing);
    ASSERT_NEAR(brick_of(*s).omega[0], 3, 1e-12);
  }
  EXPECT_NEAR(brick_of(*s).L[1], L[1], 1e-12);
  EXPECT_NEAR(brick_of(*s).L[2], L[2], 1e-12);
  EXPECT_LT(test::energy_error(*s), 1e-4);
}

// Driven about an axis of its own, which turns with it: omega_1'' = -Omega^2 omega_1 with Omega^2 = omega_3^2
// (J3 - J2)(J3 - J1)/(J1 J2), of Euler's equations.
TEST(DrivenTurns, AboutAnAxisOfTheBodyTheOthersSwing) {
  const Real spin = 4, J1 = driven_inertia[0], J2 = driven_inertia[1], J3 = driven_inertia[2];
  const Real Omega = spin * std::sqrt((J3 - J2) * (J3 - J1) / (J1 * J2));
  Real error[2];
  for (int k = 0; k < 2; ++k) {
    auto s = simulation_of(
        driven_brick(true, Vec(0.5, 0, spin), k == 0 ? 2e-3 : 1e-3, driven_by("_LOCAL", 7, spin)).text(10));
    start_ledger(*s);
    error[k] = 0;
    while (s->clock().t < 3) {
      const Eigen::Quaterniond before = brick_of(*s).q;
      s->step(do_nothing);
      const RigidBody& b = brick_of(*s);
      const Vec own = before.slerp(0.5, b.q).conjugate() * b.omega;
      ASSERT_NEAR(own[2], spin, 1e-11);
      const Real t = s->clock().t - 0.5 * s->clock().dt_old;
      error[k] = std::max(error[k], std::abs(own[0] - 0.5 * std::cos(Omega * t)));
    }
    EXPECT_LT(test::energy_error(*s), 1e-4);
  }
  EXPECT_LT(error[1], 1e-4);
  EXPECT_NEAR(error[0] / error[1], 4, 1);
}

// Driven ahead along an axis that is turned with the body: a circle.
TEST(DrivenTurns, AheadAndRoundIsACircle) {
  const Real speed = 2, rate = 0.8;
  auto s = simulation_of(driven_brick(true, Vec(0, 0, rate), 1e-3,
                                      driven_by("_LOCAL", 1, speed) + driven_by("_LOCAL", 2, 0) +
                                          driven_by("_LOCAL", 3, 0) + driven_by("_LOCAL", 5, 0) +
                                          driven_by("_LOCAL", 6, 0) + driven_by("_LOCAL", 7, rate))
                             .text(10));
  const Vec start = brick_of(*s).x;
  start_ledger(*s);
  while (s->clock().t < 5) {
    s->step(do_nothing);
    const Real a = rate * s->clock().t;
    const Vec place = start + speed / rate * Vec(std::sin(a), 1 - std::cos(a), 0);
    ASSERT_NEAR((brick_of(*s).x - place).norm(), 0, 1e-6);
  }
  EXPECT_LT(test::energy_error(*s), 1e-4);
}

// A rotation that is driven to stay 0 does, whatever moments act; the others answer them.
TEST(DrivenTurns, OneMayBeHeld) {
  SolidDeck deck = driven_brick(false, Vec::Zero(), 1e-3,
                                driven_by("", 7, 0) +
                                    "*DEFINE_CURVE\n30\n0.0,1.0\n100.0,1.0\n"
                                    "*LOAD_RIGID_BODY\n1,5,30,0.7\n1,6,30,-0.4\n1,7,30,0.9\n");
  for (Vec& x : deck.nodes) x = Vec(x[0] + 0.3 * x[1], x[1] - 0.2 * x[2], x[2] + 0.1 * x[0]);
  auto s = simulation_of(deck.text(10));
  start_ledger(*s);
  while (s->clock().t < 1) {
    s->step(do_nothing);
    ASSERT_NEAR(brick_of(*s).omega[2], 0, 1e-12);
  }
  EXPECT_GT(brick_of(*s).omega.norm(), 0.1);
  EXPECT_LT(test::energy_error(*s), 1e-3);
}

// An arm that only a joint holds, driven about the joint's axis, goes as one whose other rotations are held.
TEST(DrivenTurns, AJointMayHoldTheOthers) {
  std::array<std::vector<Vec>, 2> path;
  for (const bool held : {false, true}) {
    test::JointDeck deck;
    const int ground = deck.ground();
    const Matrix J = Vec(0.02, 0.03, 0.04).asDiagonal();
    const int arm = deck.body({.x = {0.3, 0, 0}, .J = J, .con2 = held ? 4 : 0});
    deck.joint("REVOLUTE", ground, arm, {Vec(0, 0, 0), Vec(0, 0, 0.1)});
    deck.more = fmt::format(
        "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{},7,0,7,1.0\n*DEFINE_CURVE\n7\n0.0,0.0\n0.5,6.0\n9.0,6.0\n",
        arm);
    auto s = simulation_of(deck.text(1));
    while (s->clock().t < 0.9) {
      s->step(do_nothing);
      path[held].push_back(s->bodies()->bodies().back().x);
    }
  }
  ASSERT_EQ(path[0].size(), path[1].size());
  for (std::size_t k = 0; k < path[0].size(); ++k) ASSERT_NEAR((path[0][k] - path[1][k]).norm(), 0, 1e-9);
  EXPECT_GT((path[0].back() - Vec(0.3, 0, 0)).norm(), 0.3);
}

TEST(DrivenTurns, HaveTheSameBitsOverARestart) {
  expect_same_bits(
      driven_brick(true, Vec(0.5, 0.1, 4), 1e-2, driven_by("_LOCAL", 7, 4) + driven_by("_LOCAL", 1, 1))
          .text(10),
      200, 90);
}
