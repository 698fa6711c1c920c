// Sensors that switch motions and end runs.
#include <gtest/gtest.h>

#include <cmath>

#include "loads/sensors.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/ending.hpp"

using namespace courant;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;

namespace {

constexpr Real acceleration = 50;  // of the motion that sensors switch [m/s2]

/// A free plate that is moved along z with a velocity of 50 m/s2 t, motion 30; node 9 rests beside it.
std::string moved_plate(const std::string& cards) {
  ShellDeck deck;
  deck.plate(1, 1, 1, 1, 1);
  deck.plate(1, 1, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(3, 0, 0.25)); });
  deck.part(1, 0.01, "*MAT_ELASTIC\n1,1000.0,1.0E9,0.3\n");
  deck.part(2, 0.01, "*MAT_ELASTIC\n2,1000.0,1.0E9,0.3\n");
  deck.node_set(1, [](const Vec& x) { return x[0] < 2; });
  deck.hold(2, "xyz", [](const Vec& x) { return x[0] > 2; });
  deck.cards += fmt::format(
      "*BOUNDARY_PRESCRIBED_MOTION_SET_ID\n        30lift\n1,3,0,9\n*DEFINE_CURVE\n9\n0.0,0.0\n1.0,{}\n",
      acceleration);
  deck.cards += "*CONTROL_TIMESTEP\n0.0,0.1\n" + cards;
  return deck.text(1);
}
void run_to(Simulation& s, Real t) {
  while (s.clock().t < t) s.step(do_nothing);
}
Real height(const Simulation& s) {
  return s.world().nodes.x.data(2)[0];
}
Real speed(const Simulation& s) {
  return s.world().nodes.v.data(2)[0];
}
bool on(const Simulation& s, Id id) {
  const SensorBoard* board = s.world().passes.all<SensorBoard>().front();
  return board->switch_is_on(board->find_switch(id));
}
std::string control(const std::string& first, const std::string& switches, int repeats = 0) {
  return fmt::format("*SENSOR_CONTROL\n1,PRESC-MOT,30,0,{}\n{},{}\n", repeats, first, switches);
}

}  // namespace

// z = a t^2/2 until it is 0.1 above node 5's -0.15; from then on the speed stays, until a time turns it on
// again.
TEST(Sensors, LetGoAtAHeightAndCatchAtATime) {
  const Real at = std::sqrt(2 * 0.1 / acceleration), v = acceleration * at;
  auto s =
      simulation_of(moved_plate("*SENSOR_DEFINE_NODE\n1,1,5,Z,,COORD\n*SENSOR_SWITCH\n1,SENSOR,1,GT,-0.15\n"
                                "*SENSOR_SWITCH\n2,TIME,,,0.12\n" +
                                control("ON", "1,2")));
  run_to(*s, 0.9 * at);
  EXPECT_NEAR(speed(*s), 0.9 * v, 0.01 * v);
  run_to(*s, 0.11);
  EXPECT_NEAR(speed(*s), v, 0.01 * v);
  EXPECT_NEAR(height(*s), 0.1 + v * (0.11 - at), 0.01 * 0.1);
  run_to(*s, 0.15);
  EXPECT_NEAR(speed(*s), acceleration * 0.15, 0.01 * v);
}

TEST(Sensors, TurnOnWhatIsOffAtTheStart) {
  auto s = simulation_of(
      moved_plate("*SENSOR_SWITCH\n2,TIME,,,0.05\n*SENSOR_SWITCH\n3,TIME,,,0.08\n" + control("OFF", "2,3")));
  run_to(*s, 0.049);
  EXPECT_EQ(speed(*s), 0);
  run_to(*s, 0.07);
  EXPECT_NEAR(speed(*s), acceleration * 0.07, 0.05);
  run_to(*s, 0.1);
  EXPECT_NEAR(speed(*s), acceleration * 0.08, 0.05);
}

// Off above 0.1, on below 0.2 of the speed seen: with NREP -1 both in turn, else once.
TEST(Sensors, GoThroughTheirSwitchesAgain) {
  for (const int repeats : {0, 1, -1}) {
    auto s = simulation_of(moved_plate("*SENSOR_SWITCH\n2,TIME,,,0.02\n*SENSOR_SWITCH\n3,TIME,,,0.03\n" +
                                       control("ON", "2,3", repeats)));
    run_to(*s, 0.04);
    // from 0.03 on both are on: each step changes the state, as long as it may
    const Real before = speed(*s);
    run_to(*s, 0.06);
    EXPECT_GT(speed(*s), before) << repeats;
    if (repeats >= 0) {
      EXPECT_NEAR(speed(*s), acceleration * 0.06, 0.05) << repeats;
    }
  }
}

TEST(Sensors, MeasureWindowsDelaysAndDirections) {
  auto s =
      simulation_of(moved_plate("*DEFINE_VECTOR\n7,0.0,0.0,0.0,0.0,3.0,4.0\n*SENSOR_DEFINE_NODE\n1,1,0,7,,"
                                "VEL\n2,1,0,0,,VEL\n3,1,2,,,COORD\n"
                                "*SENSOR_SWITCH\n1,SENSOR,1,GT,0.8\n2,SENSOR,2,GT,1.0\n3,SENSOR,3,LT,1."
                                "001\n4,SENSOR,2,GT,1.0,0,0.01,0.02\n"
                                "5,,2,,1.0\n"));
  const auto expect_on = [&](Id id, Real t, bool window) {
    run_to(*s, t - 1e-3);
    EXPECT_FALSE(on(*s, id)) << id;
    run_to(*s, t + 1e-3);
    EXPECT_EQ(on(*s, id), window) << id;
  };
  run_to(*s, 1e-3);
  EXPECT_TRUE(on(*s, 3));  // the side is 1 long
  EXPECT_TRUE(on(*s, 5));  // slower than 1
  run_to(*s, 0.019);
  EXPECT_FALSE(on(*s, 1));
  EXPECT_FALSE(on(*s, 2));
  run_to(*s, 0.0209);  // v . (0, 0.6, 0.8) = 0.8 at v = 1
  EXPECT_TRUE(on(*s, 1));
  EXPECT_TRUE(on(*s, 2));
  EXPECT_FALSE(on(*s, 5));
  expect_on(4, 0.05, true);
}

TEST(Sensors, EndARun) {
  auto s =
      simulation_of(moved_plate("*SENSOR_DEFINE_NODE\n1,1,0,Z,,COORD\n*SENSOR_SWITCH\n8,SENSOR,1,GT,0.1\n"
                                "*TERMINATION_SENSOR\n8\n"));
  const Ending* end = s->world().passes.all<const Ending>().front();
  while (!end->ended(s->world(), s->clock())) s->step(do_nothing);
  EXPECT_NEAR(s->clock().t, std::sqrt(2 * 0.1 / acceleration), 3 * s->clock().dt);
  EXPECT_NE(end->ended(s->world(), s->clock())->find("switch 8"), std::string::npos);
}

TEST(Sensors, SameBitsOnThreadsAndAfterARestart) {
  const std::string deck = moved_plate(
      "*SENSOR_DEFINE_NODE\n1,1,5,Z,,COORD\n*SENSOR_SWITCH\n1,SENSOR,1,GT,-0.249,0,0.0005,0.0005\n"
      "*SENSOR_SWITCH\n2,TIME,,,0.012\n" +
      control("ON", "1,2", -1));
  auto s = simulation_of(deck);
  int steps = 0;
  for (; s->clock().t < 0.015; ++steps) s->step(do_nothing);
  for (const Real part : {0.45, 0.6, 0.9})
    test::expect_same_bits(deck, steps, static_cast<int>(part * steps));
}
