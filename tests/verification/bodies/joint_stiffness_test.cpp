// Moments between rigid bodies, against closed forms: a body that turns about y on a held one.
#include <gtest/gtest.h>

#include <cmath>

#include "joint_decks.hpp"
#include "rigid/joints/joint_stiffness.hpp"
#include "same_bits.hpp"

using namespace courant;
using test::JointDeck;

namespace {

constexpr Real hinge_inertia = 0.08;

/// A hinge about y of a held body and one of inertia 0.08 about it, which starts with `rate`; cards 2 to 4.
std::string hinge(Real rate, const std::string& cards, const std::string& more = "") {
  JointDeck deck;
  const int ground = deck.ground();
  const Matrix J = Vec(0.05, hinge_inertia, 0.06).asDiagonal();
  const int body = deck.body({.J = J, .omega = {0, rate, 0}});
  deck.joint("REVOLUTE", ground, body, {Vec(0, 0, 0), Vec(0, 1, 0)});
  deck.more = fmt::format("*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED\n1,{},{}\n", ground, body) + cards + more;
  return deck.text(2);
}
Real turn_about_y(const Simulation& s) {
  const Matrix R = s.bodies()->bodies().back().q.toRotationMatrix();
  return std::atan2(R(0, 2), R(0, 0));
}
/// The ledger at the time level that the next step starts from.
EnergyLedger ledger_now(Simulation& s) {
  EnergyLedger out;
  s.step([&](World& world, const Clock& clock, const std::string&) {
    sample_energy(world, clock);
    out = world.energy;
  });
  return out;
}
const std::string line_of_5 = "*DEFINE_CURVE\n9\n-4.0,-20.0\n4.0,20.0\n";

}  // namespace

// J theta'' = -5 theta
TEST(JointStiffness, ACurveIsASpring) {
  auto s = test::simulation_of(hinge(2, "0,9\n\n\n", line_of_5));
  test::start_ledger(*s);
  const Real omega = std::sqrt(5 / hinge_inertia);
  while (s->clock().t < 2) {
    s->step(test::do_nothing);
    ASSERT_NEAR(turn_about_y(*s), 2 / omega * std::sin(omega * s->clock().t), 2e-3 * 2 / omega)
        << s->clock().t;
  }
  EXPECT_LT(std::abs(ledger_now(*s).unexplained()), 1e-3 * 0.5 * hinge_inertia * 4);
}

// With a damper: exp(-c t/(2 J)).
TEST(JointStiffness, ADamperTakesEnergyByItsCurve) {
  auto s = test::simulation_of(
      hinge(2, "0,9,0,0,10\n\n\n", line_of_5 + "*DEFINE_CURVE\n10\n-100.0,-20.0\n100.0,20.0\n"));
  test::start_ledger(*s);
  const Real decay = 0.2 / (2 * hinge_inertia), omega = std::sqrt(5 / hinge_inertia - decay * decay);
  while (s->clock().t < 2) {
    s->step(test::do_nothing);
    const Real t = s->clock().t;
    ASSERT_NEAR(turn_about_y(*s), 2 / omega * std::exp(-decay * t) * std::sin(omega * t), 4e-3 * 2 / omega)
        << t;
  }
  const EnergyLedger end = ledger_now(*s);
  EXPECT_NEAR(end.dissipated, 0.5 * hinge_inertia * 4 * (1 - std::exp(-2 * decay * 2)), 0.005);
  EXPECT_LT(std::abs(end.unexplained()), 2e-3 * 0.5 * hinge_inertia * 4);
}

// Friction of 0.1 stops a rate of 2 within J w^2/(2 M) = 1.6 rad, but for the elastic way of 1e-3 rad.
TEST(JointStiffness, FrictionBrakesAndHolds) {
  auto s = test::simulation_of(hinge(2, "\n0,0,100.0,0.1\n\n"));
  test::start_ledger(*s);
  while (s->clock().t < 1) s->step(test::do_nothing);
  EXPECT_NEAR(turn_about_y(*s), 2 * 1 - 0.5 * 0.1 / hinge_inertia, 5e-3) << "at t = 1";
  while (s->clock().t < 2) s->step(test::do_nothing);
  EXPECT_NEAR(turn_about_y(*s), 1.6, 5e-3);
  const EnergyLedger end = ledger_now(*s);
  EXPECT_NEAR(end.dissipated, 0.16, 1e-3);
  EXPECT_LT(std::abs(end.unexplained()), 1e-3);
}

// A stop at 60 degrees of 50 a radian: it turns back after half a period of its spring.
TEST(JointStiffness, AStopTurnsItBack) {
  auto s = test::simulation_of(hinge(2, "\n0,0,50.0\n0,0,-30.0,60.0\n"));
  const Real stop = pi / 3, omega = std::sqrt(50 / hinge_inertia);
  Real furthest = 0;
  while (s->clock().t < 1) {
    s->step(test::do_nothing);
    furthest = std::max(furthest, turn_about_y(*s));
  }
  EXPECT_NEAR(furthest, stop + 2 / omega, 1e-3);
  EXPECT_NEAR(turn_about_y(*s), stop - 2 * (1 - stop / 2 - pi / omega), 2e-3);
  EXPECT_NEAR(s->bodies()->bodies().back().omega[1], -2, 2e-3);
}

// It goes round: angles are counted beyond 90 and 180 degrees.
TEST(JointStiffness, AnglesGoOnBeyondAFullTurn) {
  JointStiffness joint;
  for (int k = 1; k <= 200; ++k) {
    const Real angle = 0.07 * k;
    const JointAngles now = angles_of(joint, Eigen::Quaterniond::Identity(),
                                      Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec::UnitY())));
    ASSERT_NEAR(now.angle[1], angle, 1e-7);
    ASSERT_NEAR((now.axis[1] - Vec::UnitY()).norm(), 0, 1e-12);
    for (std::size_t i = 0; i < 3; ++i) joint.about[i].angle = now.angle[i];
  }
}

// Rates of the angles are g_i.omega: by differences for any turn.
TEST(JointStiffness, AxesTellTheRatesOfTheAngles) {
  JointStiffness joint;
  joint.axes_a = Eigen::AngleAxisd(0.4, Vec(1, 2, 3).normalized()).toRotationMatrix();
  joint.axes_b = Eigen::AngleAxisd(0.9, Vec(3, -1, 1).normalized()).toRotationMatrix();
  const Eigen::Quaterniond a(Eigen::AngleAxisd(0.3, Vec(1, 0, 1).normalized()));
  const Eigen::Quaterniond b(Eigen::AngleAxisd(0.8, Vec(0, 1, 1).normalized()));
  const Vec omega(0.3, -0.7, 0.5);
  constexpr Real h = 1e-6;
  const auto at = [&](Real t) {
    return angles_of(joint, a,
                     Eigen::Quaterniond(Eigen::AngleAxisd(t * omega.norm(), omega.normalized())) * b);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const Real rate = (at(h).angle[k] - at(-h).angle[k]) / (2 * h);
    EXPECT_NEAR(rate, at(0).axis[k].dot(omega), 1e-8) << k;
  }
}

TEST(JointStiffness, GivesTheSameBits) {
  test::expect_same_bits(hinge(2, "0,9\n0,0,100.0,0.1\n0,0,-5.0,5.0\n", line_of_5), 500, 200);
}
