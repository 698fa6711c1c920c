// Joints as penalty springs: where the positions of a deck contradict each other.
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

/// An elastic cube adrift beside the bodies, whose step is 0.9 of 2 ms with the usual TSSFAC.
void add_cube(JointDeck& deck) {
  std::string corners;
  for (int k = 0; k < 8; ++k) {
    const Real x = (k & 1) != ((k & 2) >> 1), y = (k & 2) / 2, z = (k & 4) / 4;
    deck.nodes += fmt::format("{},{},{},{}\n", ++deck.node, 10 + 0.1 * x, 0.1 * y, 0.1 * z);
    corners += fmt::format("{:8}", deck.node);
  }
  deck.elements += fmt::format("{:8}{:8}{}\n", 900, 900, corners);
  deck.parts += "*PART\ncube\n900,1,900\n*MAT_ELASTIC\n900,1000.,2.5e6,0.\n";
}

/// The speed of the askew door after 6 s.
Real speed_of_door(JointDeck deck, const std::string& steps) {
  deck.more += steps;
  auto s = simulation_of(deck.text(6));
  while (s->clock().t < 6) s->step(do_nothing);
  sample_energy(s->world(), s->clock());
  EXPECT_LT(std::abs(s->world().energy.error()), 0.01) << steps;
  return s->bodies()->bodies()[1].omega[2];
}

}  // namespace

// Hinges askew by 2e-3 between two bodies in free space are springs.
TEST(JointSprings, AFreePairThatDoesNotFitKeepsItsAngularMomentum) {
  JointDeck deck;
  const Vec spin(0.5, -0.3, 4);
  const auto speed = [&](const Vec& x) { return Vec(spin.cross(x)); };
  const Vec left(-0.4, 0, 1), right(0.4, 0, 1);
  const int a =
      deck.body({.x = left, .m = 20, .J = Vec(7, 8, 1.2).asDiagonal(), .v = speed(left), .omega = spin});
  const int b =
      deck.body({.x = right, .m = 10, .J = Vec(5, 6, 1).asDiagonal(), .v = speed(right), .omega = spin});
  deck.joint("REVOLUTE", a, b, {Vec(0, 0, 0.2), Vec(0, 0, 0.3)});
  deck.joint("REVOLUTE", a, b, {Vec(0, 0, 1.8), Vec(2e-4, 0, 1.9)});
  auto s = simulation_of(deck.text(10));
  const auto momentum = [&] {  // of the half step, with positions of the step before: exact
    Vec out = Vec::Zero();
    for (const RigidBody& body : s->bodies()->bodies())
      out += body.L + (body.x - body.v * s->clock().dt_old).cross(body.m * body.v);
    return out;
  };
  s->step(do_nothing);
  const Vec start = momentum();
  const Real energy = s->bodies()->kinetic_energy();
  while (s->clock().t < 10) s->step(do_nothing);
  EXPECT_GT(s->world().maxima["joint_spring_gap_share"], 1e-6) << "springs";
  EXPECT_LT((momentum() - start).norm(), 1e-9 * start.norm());
  EXPECT_NEAR(s->bodies()->kinetic_energy(), energy, 0.02 * energy);
}

// One mechanism that does not fit leaves the joints of others exact, though both hang on the ground.
TEST(JointSprings, OtherMechanismsStayExact) {
  JointDeck deck = askew_door(2e-4);
  const int ground = deck.ground();
  const int bob = deck.body({.x = {5, 0, -1}, .m = 2, .omega = {0, 0.1, 0}});
  deck.joint("REVOLUTE", ground, bob, {Vec(5, 0, 0), Vec(5, 0.1, 0)});
  deck.gravity(9.81);
  auto s = simulation_of(deck.text(2));
  while (s->clock().t < 2) s->step(do_nothing);
  const std::vector<Joint>& joints = s->world().passes.all<Joints>().front()->all();
  EXPECT_TRUE(joints[0].yields && joints[1].yields);
  EXPECT_FALSE(joints[2].yields);
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

// What springs brake is a matter of their stiffness, which stays the same while steps get shorter: by TSSFAC
// where elements limit them, by LCTM where nothing deforms.
TEST(JointSprings, DoNotGetStifferAsStepsGetShorter) {
  JointDeck with_cube = askew_door(2e-3);
  add_cube(with_cube);
  std::vector<Real> by_tssfac, by_curve;
  for (const Real part : {1.0, 0.5, 0.25}) {
    by_tssfac.push_back(speed_of_door(with_cube, fmt::format("*CONTROL_TIMESTEP\n0.,{}\n", 0.9 * part)));
    by_curve.push_back(speed_of_door(
        askew_door(2e-3),
        fmt::format("*CONTROL_TIMESTEP\n0.,,,,,9\n*DEFINE_CURVE\n9\n0.,{0}\n9.,{0}\n", 4e-3 * part)));
  }
  for (const auto& speeds : {by_tssfac, by_curve}) {
    EXPECT_LT(speeds[2], 0.9) << "they brake";
    EXPECT_NEAR(speeds[0], speeds[1], 0.005);
    EXPECT_NEAR(speeds[0], speeds[2], 0.005);
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
