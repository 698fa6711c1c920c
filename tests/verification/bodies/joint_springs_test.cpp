// Joints as penalty springs: where the card asks for them, and where the places of a deck contradict each
// other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/run_error.hpp"
#include "joint_decks.hpp"
#include "same_bits.hpp"
#include "time/step.hpp"

using namespace courant;
using test::do_nothing;
using test::JointDeck;
using test::largest_gap;
using test::simulation_of;

namespace {

const std::string exact = "*CONTROL_RIGID\n1\n";

/// A ball at rest below a ground, held by a spherical joint at its centre, falls by g.
JointDeck hanging_ball(Real m, Real g, const std::string& penalty) {
  JointDeck deck;
  const int ground = deck.ground();
  const int ball = deck.body({.m = m, .J = Matrix::Identity()});
  deck.joint("SPHERICAL", ground, ball, {Vec::Zero()}, 0, penalty);
  deck.gravity(g);
  return deck;
}

/// A door of two hinges, the upper one `beside` the axis of the lower one.
JointDeck askew_door(Real beside) {
  JointDeck deck;
  const int ground = deck.ground();
  const int door = deck.body(
      {.x = {0.4, 0, 1}, .m = 20, .J = Vec(7, 8, 1.2).asDiagonal(), .v = {0, 0.4, 0}, .omega = {0, 0, 1}});
  deck.joint("REVOLUTE", ground, door, {Vec(0, 0, 0.2), Vec(0, 0, 0.3)});
  deck.joint("REVOLUTE", ground, door, {Vec(0, 0, 1.8), Vec(beside, 0, 1.9)});
  return deck;
}

/// What screws drive: a plate that turns about its centre with a joint `off` that, and a block that slides.
JointDeck off_centre(Real off, const std::string& control) {
  JointDeck deck;
  const int plate = deck.body({.m = 0.1, .J = 30 * Matrix::Identity(), .con1 = 5, .con2 = 5});
  const int block =
      deck.body({.x = {40, 0, 0}, .m = 0.1, .J = 30 * Matrix::Identity(), .con1 = 5, .con2 = 7});
  deck.joint("SCREW", plate, block, {Vec(5, off, 0), Vec(30, off, 0), Vec(5, off + 10, 0)}, 4);
  deck.more =
      control +
      fmt::format(
          "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{},5,2,7\n*DEFINE_CURVE\n7\n0.,0.\n6.,1.\n100.,16.6667\n",
          plate);
  return deck;
}

}  // namespace

// x'' = -g - (k x + d x')/m with k = 0.1 RPS m/dt^2, d = 0.2 DAMP sqrt(k m).
TEST(JointSprings, ABallSwingsAndComesToRestWhereItsSpringCarriesIt) {
  const Real m = 2, g = 9.81, rps = 0.01;
  auto s = simulation_of(hanging_ball(m, g, "      0.01       1.0").text(1));
  s->step(do_nothing);
  const Real dt = s->clock().dt_old, omega = std::sqrt(0.1 * rps) / dt, xi = 0.1;
  const Real sag = g / (omega * omega), swings = omega * std::sqrt(1 - xi * xi);
  Real worst = 0;
  for (int k = 1; k < 4000; ++k) {
    const Real t = s->clock().t;
    const Real x = -sag * (1 - std::exp(-xi * omega * t) *
                                   (std::cos(swings * t) + xi * omega / swings * std::sin(swings * t)));
    worst = std::max(worst, std::abs(s->bodies()->bodies()[1].x[2] - x));
    s->step(do_nothing);
    ASSERT_NEAR(s->clock().dt_old, dt, 1e-9 * dt);
  }
  EXPECT_LT(worst, 0.02 * sag);  // half a step of the first push: omega dt is 0.03
  EXPECT_NEAR(s->bodies()->bodies()[1].x[2], -sag, 1e-3 * sag);
  sample_energy(s->world(), s->clock());
  EXPECT_GT(s->world().energy.dissipated, 0);
  EXPECT_LT(std::abs(s->world().energy.residual()), 0.02 * m * g * sag);
}

// DAMP 0.01: mean accelerations take nothing.
TEST(JointSprings, WithoutDampingASwingGoesOn) {
  const Real m = 2, g = 9.81;
  auto s = simulation_of(hanging_ball(m, g, "      0.01      0.01").text(1));
  s->step(do_nothing);
  const Real omega = std::sqrt(0.1 * 0.01) / s->clock().dt_old, sag = g / (omega * omega);
  Real lowest = 0;
  for (int k = 1; k < 5000; ++k) {
    s->step(do_nothing);
    if (k > 4500) lowest = std::min(lowest, s->bodies()->bodies()[1].x[2]);
  }
  EXPECT_NEAR(lowest, -2 * sag, 0.01 * sag);
}

// Exact hinges whose axes are askew by 1e-3 and 2e-3 hold a door.
TEST(JointSprings, ADoorWithHingesAskewGoesOnTurning) {
  for (const Real beside : {1e-4, 2e-4}) {
    JointDeck deck = askew_door(beside);
    auto s = simulation_of(deck.text(6));
    while (s->clock().t < 6) s->step(do_nothing);
    EXPECT_NEAR(s->bodies()->bodies().back().omega[2], 1, 0.03) << beside;
    EXPECT_LT(largest_gap(*s), 20 * beside);
    EXPECT_GT(s->world().maxima["joint_spring_gap_share"], 0.1 * beside);
    sample_energy(s->world(), s->clock());
    EXPECT_LT(std::abs(s->world().energy.error()), 0.01) << beside;
    deck.more += exact;
    auto locked = simulation_of(deck.text(6));
    while (locked->clock().t < 1) locked->step(do_nothing);
    EXPECT_LT(locked->bodies()->bodies().back().omega[2], 0.1) << "exact joints lock it " << beside;
  }
}

// The axis goes round the centre, as both bodies are held across it: the gap is what it is off, twice.
TEST(JointSprings, AScrewWhoseAxisIsOffTheCentreItTurnsAboutFeedsAllTheSame) {
  const Real off = 0.05;
  auto s = simulation_of(off_centre(off, "").text(40));
  const auto apart = [&] { return s->bodies()->bodies()[1].x[0] - s->bodies()->bodies()[0].x[0]; };
  const Real start = apart();
  while (s->clock().t < 40) s->step(do_nothing);
  EXPECT_NEAR(start - apart(), 4 * 6.6667, 0.03);  // a step beyond 40
  EXPECT_NEAR(s->world().maxima["joint_gap"], 2 * off, 0.02 * off);
  EXPECT_THROW(
      {
        auto held = simulation_of(off_centre(off, exact).text(40));
        while (held->clock().t < 40) held->step(do_nothing);
      },
      RunError);
}

TEST(JointSprings, AreTheSameAfterARestartAndOnAnyNumberOfThreads) {
  test::expect_same_bits(off_centre(0.05, "").text(40), 400, 200);
}
