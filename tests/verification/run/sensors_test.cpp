// Sensors that switch motions and end runs.
#include <gtest/gtest.h>

#include <cmath>

#include "joint_decks.hpp"
#include "loads/sensors/sensors.hpp"
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

namespace {

constexpr Real force_per_time = 40;  // of a weight that grows with time [m/s3]
const std::string growing_weight =
    fmt::format("*LOAD_BODY_Z\n9,1.0\n*DEFINE_CURVE\n9\n0.0,0.0\n10.0,{}\n", 10 * force_per_time);

}  // namespace

// A body of 3 kg hangs from a spherical joint: the force on it is m force_per_time t.
TEST(Sensors, EndARunByTheForceOfAJoint) {
  const Real m = 3, force = 12;
  for (const std::string direction : {"Z", "0"}) {
    test::JointDeck deck;
    const int ground = deck.ground();
    const int body = deck.body({.x = Vec(0, 0, -1), .m = m});
    deck.joint("SPHERICAL", ground, body, {Vec(0, 0, 0)});
    deck.more = growing_weight + "*SENSOR_DEFINE_FORCE\n1,JOINT,1," + direction +
                fmt::format("\n*SENSOR_SWITCH\n8,SENSOR,1,GT,{}\n*TERMINATION_SENSOR\n8\n", force);
    auto s = simulation_of(deck.text(1));
    const Ending* end = s->world().passes.all<const Ending>().front();
    while (s->clock().t < 1 && !end->ended(s->world(), s->clock())) s->step(do_nothing);
    EXPECT_NEAR(s->clock().t, force / (m * force_per_time), 3 * s->clock().dt) << direction;
  }
}

namespace {

/// A plate of 10 kg lies on one that is held; what sensors say follows.
std::string lying_plate(const std::string& cards) {
  ShellDeck deck;
  deck.plate(2, 2, 2, 2, 1, [](const Vec& x) { return Vec(x - Vec(0.5, 0.5, 0)); });
  deck.plate(1, 1, 2, 2, 2, [](const Vec& x) { return Vec(x + Vec(0, 0, 0.01)); });
  deck.part(1, 0.01, "*MAT_ELASTIC\n1,1000.0,1.0E9,0.3\n");
  deck.part(2, 0.01, "*MAT_ELASTIC\n2,1000.0,1.0E9,0.3\n");
  deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[2] < 0.005; });
  deck.cards +=
      "*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID\n         4lies\n2,1,3,3\n\n\n" + growing_weight + cards;
  return deck.text(1);
}

}  // namespace

// The contact bears m force_per_time t, and is switched off where that is 100 N: from then on the plate
// falls, z = -force_per_time ((t^3 - T^3)/6 - T^2 (t - T)/2).
TEST(Sensors, ForceOfAContactSwitchesItOff) {
  const Real m = 10, force = 100, T = force / (m * force_per_time);
  const std::string cards = fmt::format(
      "*SENSOR_DEFINE_FORCE\n1,CONTACT,4,Z\n*SENSOR_SWITCH\n8,SENSOR,1,GT,{}\n"
      "*SENSOR_CONTROL\n1,CONTACT,4\nON,8\n",
      force);
  auto s = simulation_of(lying_plate(cards));
  Real off = 0;
  const auto z = [&] {
    Real sum = 0;
    for (Index n = 9; n < 18; ++n) sum += s->world().nodes.x.data(2)[n] / 9;
    return sum;
  };
  while (s->clock().t < 2 * T) {
    s->step(do_nothing);
    if (off == 0 && on(*s, 8)) off = s->clock().t;
  }
  EXPECT_NEAR(off, T, 0.01 * T);
  const Real t = s->clock().t;
  EXPECT_NEAR(z() - 0.01, -force_per_time * ((t * t * t - T * T * T) / 6 - T * T * (t - T) / 2),
              0.02 * force_per_time * T * T * T);
  EXPECT_LT(z(), -0.1);  // through what it lay on
}

TEST(Sensors, ContactsThatAreOffComeOn) {
  auto s = simulation_of(lying_plate("*SENSOR_SWITCH\n8,TIME,,,0.3\n*SENSOR_CONTROL\n1,CONTACT,4\nOFF,8\n"));
  while (s->clock().t < 0.1) s->step(do_nothing);
  EXPECT_LT(s->world().nodes.v.data(2)[9], -0.9 * force_per_time * 0.005);  // nothing bears it
}

// 3 and the time: what CALC-MATH makes of both.
TEST(Sensors, CalculateWithSensors) {
  for (const char* calc : {"SUM", "MAXMAG", "MULTIPLY", "SQRE", "MIN", "ABSSUM", "SUMABS"}) {
    const Real t = 0.05, both[] = {-3, t};
    const Real value = std::string(calc) == "SUM"        ? both[0] + t
                       : std::string(calc) == "MAXMAG"   ? 3
                       : std::string(calc) == "MULTIPLY" ? -3 * t
                       : std::string(calc) == "SQRE"     ? 9 + t * t
                       : std::string(calc) == "MIN"      ? -3
                       : std::string(calc) == "ABSSUM"   ? 3 - t
                                                         : 3 + t;
    auto s = simulation_of(moved_plate(fmt::format(
        "*DEFINE_CURVE\n77\n0.0,-3.0\n1.0,-3.0\n*SENSOR_DEFINE_MISC\n1,CURVE,77\n2,TIME\n"
        "*SENSOR_DEFINE_CALC-MATH\n3,{},1,2\n*SENSOR_SWITCH\n5,SENSOR,3,GT,{:.9g}\n6,SENSOR,3,LT,{:.9g}\n",
        calc, value - 0.01, value + 0.01)));
    run_to(*s, t);
    EXPECT_TRUE(on(*s, 5)) << calc;
    EXPECT_TRUE(on(*s, 6)) << calc;
  }
}

TEST(Sensors, OfForcesHaveTheSameBitsOnThreadsAndAfterARestart) {
  const std::string deck = lying_plate(
      "*SENSOR_DEFINE_FORCE\n1,CONTACT,4,Z\n*SENSOR_SWITCH\n8,SENSOR,1,GT,3.0\n*SENSOR_SWITCH\n9,TIME,,,0."
      "009\n"
      "*SENSOR_CONTROL\n1,CONTACT,4,0,-1\nON,8,9\n");
  auto s = simulation_of(deck);
  int steps = 0;
  for (; s->clock().t < 0.012; ++steps) s->step(do_nothing);
  for (const Real part : {0.5, 0.7, 0.9}) test::expect_same_bits(deck, steps, static_cast<int>(part * steps));
}

namespace {

/// What sensor 1 measures, and what the histories show of boundaries, at the same time.
struct MeasuredBoundary {
  Real sensor = 0;
  Sample sample{};
};
MeasuredBoundary measure_boundary(Simulation& s) {
  MeasuredBoundary out;
  s.step([&](World& world, const Clock& clock, const std::string& who) {
    out.sensor = world.passes.all<SensorBoard>().front()->sensors().front().value(world, clock);
    out.sample = s.sample(who);
  });
  return out;
}

}  // namespace

// A plate hangs in its held edge while its weight grows: both are what spcforc prints of its nodes, the sum
// is m g where the plate is held alone.
TEST(Sensors, ForceOfConstraintsIsThatOfSpcforc) {
  const auto deck = [](const std::string& vid) {
    ShellDeck deck;
    deck.plate(1, 1, 2, 2, 1);
    deck.part(1, 0.01, "*MAT_ELASTIC\n1,1000.0,1.0E9,0.3\n");
    deck.node_set(1, [](const Vec& x) { return x[0] < 0.1; });
    deck.node_set(2, [](const Vec& x) { return x[0] > 0.9; });
    deck.cards +=
        "*BOUNDARY_SPC_SET_ID\n         4edge\n1,0,0,0,1,0,1,0\n         5other\n2,0,0,0,1\n"
        "*BOUNDARY_SPC_SET\n1,0,1,1\n2,0,1,1\n" +
        growing_weight +
        fmt::format(
            "*SENSOR_DEFINE_FORCE\n1,SPC,4,{}\n*SENSOR_SWITCH\n8,SENSOR,1,GT,10.0\n"
            "*TERMINATION_SENSOR\n8\n",
            vid);
    return deck.text(1);
  };
  for (const std::string vid : {"Z", "M", "YMOMENT"}) {
    auto s = simulation_of(deck(vid));
    while (s->clock().t < 0.02) s->step(do_nothing);
    const MeasuredBoundary now = measure_boundary(*s);
    Vec force = Vec::Zero(), moment = Vec::Zero();
    Real all = 0;
    const Nodes& nodes = s->world().nodes;
    for (const BoundaryForce& one : now.sample.boundary_forces) {
      const auto n = static_cast<Index>(std::find(nodes.id.data(), nodes.id.data() + nodes.size(), one.id) -
                                        nodes.id.data());
      all += one.force[2];
      if (nodes.x.data(0)[n] > 0.1) continue;
      force[2] += one.force[2], moment[1] += one.moment[1];
    }
    const Real expected = vid == "YMOMENT" ? moment[1] : force[2];
    EXPECT_GT(std::abs(expected), 1e-3) << vid;
    EXPECT_NEAR(now.sensor, vid == "M" ? std::abs(expected) : expected, 1e-12 * std::abs(expected)) << vid;
    EXPECT_GT(all, force[2]);
  }
}

// m times 50 m/s2 of 10 kg of nodes, what bndout prints; the other direction, driven by another card, does
// not count.
TEST(Sensors, ForceOfMotionsIsThatOfBndout) {
  for (const std::string vid : {"Z", "0", "X"}) {
    auto s =
        simulation_of(moved_plate("*BOUNDARY_PRESCRIBED_MOTION_SET_ID\n        31side\n1,1,0,9,0.5\n"
                                  "*SENSOR_DEFINE_FORCE\n1,PRESC-MOT,30," +
                                  vid +
                                  "\n*SENSOR_SWITCH\n8,SENSOR,1,GT,1e9\n"
                                  "*TERMINATION_SENSOR\n8\n"));
    while (s->clock().t < 0.01) s->step(do_nothing);
    const MeasuredBoundary now = measure_boundary(*s);
    Real z = 0;
    for (const BoundaryForce& one : now.sample.boundary_forces) z += one.force[2];
    EXPECT_NEAR(z, 10 * acceleration, 1e-3 * 10 * acceleration);
    EXPECT_NEAR(now.sensor, vid == "X" ? 0 : z, 1e-9 * z) << vid;
  }
}

// A rigid body of 3 kg is driven along z: m a, as bndout's.
TEST(Sensors, ForceOfMotionsOfBodies) {
  test::JointDeck deck;
  const int body = deck.body({.x = Vec(0, 0, -1), .m = 3});
  deck.more = fmt::format(
      "*BOUNDARY_PRESCRIBED_MOTION_RIGID_ID\n        30lift\n{},3,0,9\n*DEFINE_CURVE\n9\n0.0,0.0\n1.0,{}\n"
      "*SENSOR_DEFINE_FORCE\n1,PRESC-MOT,30,Z\n*SENSOR_SWITCH\n8,SENSOR,1,GT,1e9\n*TERMINATION_SENSOR\n8\n",
      body, acceleration);
  auto s = simulation_of(deck.text(1));
  while (s->clock().t < 0.1) s->step(do_nothing);
  const MeasuredBoundary now = measure_boundary(*s);
  EXPECT_NEAR(now.sensor, 3 * acceleration, 1e-6 * 3 * acceleration);
  EXPECT_NEAR(now.sensor, now.sample.boundary_forces.at(0).force[2], 1e-9);
}
