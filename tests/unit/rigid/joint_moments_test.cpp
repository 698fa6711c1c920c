// Moments between two bodies, each kind of them with both senses, against closed forms and balances.
#include <gtest/gtest.h>

#include <cmath>

#include "../../verification/bodies/joint_decks.hpp"
#include "rigid/joints/joint_stiffness_pass.hpp"

using namespace courant;

namespace joint_moments_test {
namespace {

using test::do_nothing;
using test::JointDeck;
using test::simulation_of;

constexpr Real inertia = 0.08;

/// A hinge about y between a body of large inertia, or one that is held, and one of 0.08 that turns.
struct Hinge {
  std::string cards;  ///< 2 to 4 of the joint's stiffness
  std::string curves = "";
  Real rate = 2;  ///< of the second body, or of the first one
  bool first_turns = false, free = false;
};
std::unique_ptr<Simulation> hinge(const Hinge& h) {
  JointDeck deck;
  const Matrix J = Vec(0.05, inertia, 0.06).asDiagonal();
  const test::GivenBody turns{.J = J, .omega = {0, h.rate, 0}};
  test::GivenBody other{.J = J};
  if (!h.free) other.con1 = other.con2 = 7;
  const int a = deck.body(h.first_turns ? turns : other), b = deck.body(h.first_turns ? other : turns);
  deck.joint("REVOLUTE", a, b, {Vec(0, 0, 0), Vec(0, 1, 0)});
  deck.more = fmt::format("*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED\n1,{},{}\n", a, b) + h.cards + h.curves;
  return simulation_of(deck.text(2));
}
/// Of the second body against the first, by what they turned about y.
Real angle_of(const Simulation& s) {
  const auto turn = [](const RigidBody& b) {
    const Matrix R = b.q.toRotationMatrix();
    return std::atan2(R(0, 2), R(0, 0));
  };
  return turn(s.bodies()->bodies()[1]) - turn(s.bodies()->bodies()[0]);
}
/// The largest residual of the balance up to a time, of the energy of the start.
Real worst_balance(Simulation& s, Real until) {
  test::start_ledger(s);
  const Real initial = s.world().energy.initial;
  Real worst = 0;
  while (s.clock().t < until)
    s.step([&](World& world, const Clock& clock, const std::string&) {
      sample_energy(world, clock);
      worst = std::max(worst, std::abs(world.energy.unexplained()) / initial);
    });
  return worst;
}
const std::string spring_of_5 = "*DEFINE_CURVE\n9\n-4.0,-20.0\n4.0,20.0\n";
const std::string damper_of_02 = "*DEFINE_CURVE\n10\n-100.0,-20.0\n100.0,20.0\n";

}  // namespace

// Springs, dampers, friction and stops: whichever body turns, and which shift, the balance holds through all
// of it (leapfrog: the square of omega dt/2, 0.25 at the share of the stable step that the joint takes, of
// the part that swings; an error of a factor of 2 in any energy is above 0.1).
TEST(JointMoments, BalanceInBothSensesAndForBothBodies) {
  struct Case {
    const char* what;
    std::string cards, curves;
  };
  const Case cases[] = {{"spring", "0,9\n\n\n", spring_of_5},
                        {"spring and damper", "0,9,0,0,10\n\n\n", spring_of_5 + damper_of_02},
                        {"friction", "\n0,0,5.0,0.1\n\n", ""},
                        {"stops", "\n0,0,50.0\n0,0,-30.0,30.0\n", ""}};
  for (const Case& one : cases)
    for (const Real rate : {2.0, -2.0})
      for (const bool first : {false, true})
        for (const bool free : {false, true}) {
          auto s = hinge({.cards = one.cards,
                          .curves = one.curves + "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,4\n*DEFINE_CURVE\n4\n"
                                                 "0.0,2.0e-3\n9.0,2.0e-3\n",
                          .rate = rate,
                          .first_turns = first,
                          .free = free});
          EXPECT_LT(worst_balance(*s, 0.8), 0.01) << one.what << rate << first << free;
        }
}

// J theta'' = -c (theta' - ...): only what turns against each other is damped. Two equal free bodies: the
// relative rate falls by exp(-2 c t/J), the sum stays.
TEST(JointMoments, DampersSeeTheDifferenceOfBothRates) {
  for (const bool first : {false, true}) {
    auto s = hinge({.cards = "0,0,0,0,10\n\n\n", .curves = damper_of_02, .first_turns = first, .free = true});
    while (s->clock().t < 0.3) s->step(do_nothing);
    const Real t = s->clock().t - 0.5 * s->clock().dt_old;
    const auto rate = [&](std::size_t k) { return s->bodies()->bodies()[k].omega[1]; };
    EXPECT_NEAR(rate(0) + rate(1), 2, 1e-9);
    EXPECT_NEAR(rate(first ? 0 : 1) - rate(first ? 1 : 0), 2 * std::exp(-2 * 0.2 * t / inertia), 0.02);
  }
}

// Stops at -25 and 40 degrees of 50 a radian: it goes beyond by rate/omega, and comes back with its rate.
TEST(JointMoments, EachStopTurnsItBack) {
  const Real omega = std::sqrt(50 / inertia);
  for (const Real sense : {1.0, -1.0}) {
    auto s = hinge({.cards = "\n0,0,50.0\n0,0,-25.0,40.0\n", .rate = 2 * sense});
    Real furthest = 0;
    const Real stop = (sense > 0 ? 40 : 25) * pi / 180;
    while (s->clock().t < stop / 2 + 2 * pi / omega) {
      s->step(do_nothing);
      furthest = std::max(furthest, sense * angle_of(*s));
    }
    EXPECT_NEAR(furthest, stop + 2 / omega, 2e-3) << sense;
    EXPECT_NEAR(s->bodies()->bodies()[1].omega[1], -2 * sense, 2e-2);
  }
}

// The step of a spring is 0.5 2/sqrt(k/J), of the spring of friction and stops with twice the stiffness where
// both may act, of a damper 0.5 J/c.
TEST(JointMoments, AskForTheStepThatTheyNeed) {
  const auto limit = [](const std::string& cards, const std::string& curves) {
    auto s = hinge({.cards = cards, .curves = curves});
    s->step(do_nothing);
    return s->world().passes.all<JointStiffnesses>().front()->limit(s->world(), s->clock()).dt;
  };
  EXPECT_NEAR(limit("0,9\n\n\n", spring_of_5), 1 / std::sqrt(5 / inertia), 1e-9);
  EXPECT_NEAR(limit("\n0,0,50.0\n0,0,-25.0,40.0\n", ""), 1 / std::sqrt(50 / inertia), 1e-9);
  EXPECT_NEAR(limit("\n0,0,50.0,0.1\n\n", ""), 1 / std::sqrt(2 * 50 / inertia), 1e-9);
  EXPECT_NEAR(limit("0,0,0,0,10\n\n\n", "*DEFINE_CURVE\n10\n-100.0,-2000.0\n100.0,2000.0\n"),
              0.5 * inertia / 20, 1e-9);
}

}  // namespace joint_moments_test
