// Cards of sensors: what each measures, and how controls go through their switches.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "../../verification/shells/shell_decks.hpp"
#include "../../verification/structures/solid_decks.hpp"
#include "loads/sensors/sensors.hpp"
#include "state/shared_fields.hpp"

using namespace courant;

namespace sensor_cards_test {
namespace {

using test::ShellDeck;
using test::simulation_of;

/// Two heavy shells of 0.3 x 0.2 in z = 0, of nodes 1 2 3 / 4 5 6, whose nodes are moved by hand; nodes 1 and
/// 4 are held, 3 is driven, and each node has a load.
std::string plate(const std::string& sensors, const std::string& switches) {
  ShellDeck deck;
  deck.plate(0.6, 0.2, 2, 1, 1);
  deck.part(1, 0.1, "*MAT_ELASTIC\n1,1.0E7,1.0E-3,0.3\n");
  deck.cards += "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,99\n*DEFINE_CURVE\n99\n0.0,0.01\n99.0,0.01\n";
  deck.node_set(1, [](const Vec& x) { return x[0] < 0.01; });
  deck.node_set(2, [](const Vec& x) { return x[0] > 0.01; });
  deck.node_set(3, [](const Vec&) { return true; });
  deck.cards +=
      "*BOUNDARY_SPC_SET_ID\n41\n1,0,1,0,1,0,1\n*BOUNDARY_PRESCRIBED_MOTION_NODE_ID\n31\n3,2,0,8\n"
      "*BOUNDARY_PRESCRIBED_MOTION_NODE_ID\n32\n3,7,0,8\n*DEFINE_CURVE\n8\n0.0,0.0\n9.0,0.0\n"
      "*LOAD_NODE_SET\n3,1,9,3.0\n3,2,9,5.0\n3,3,9,7.0\n3,5,9,0.3\n3,6,9,0.5\n3,7,9,0.7\n"
      "*DEFINE_CURVE\n9\n0.0,1.0\n9.0,1.0\n*DEFINE_CURVE\n6\n0.0,10.0\n1.0,14.0\n"
      "*DEFINE_VECTOR\n7,1.0,1.0,1.0,1.0,4.0,5.0\n";
  deck.cards += sensors + switches;
  return deck.text(1);
}

}  // namespace

TEST(SensorCards, EachMeasuresWhatItsFieldsSay) {
  struct Case {
    std::string card;
    Real value;
  };
  const Vec x2(0.3, 0, 0), x6(0.6, 0.2, 0), x4(0, 0.2, 0), d(0, 0.6, 0.8);
  const auto v = [](const Vec& x) { return Vec(1 + x[0], 2 - x[1], 3 + 5 * x[0]); };
  const Real two = 2, of_support = -two;  // nodes
  const std::vector<Case> cases{{"*SENSOR_DEFINE_NODE\n{},2,0,X,,COORD\n", x2[0]},
                                {"*SENSOR_DEFINE_NODE\n{},6,0,Y,,COORD\n", x6[1]},
                                {"*SENSOR_DEFINE_NODE\n{},6,0,,,COORD\n", x6.norm()},
                                {"*SENSOR_DEFINE_NODE\n{},6,4,X,,COORD\n", x6[0] - x4[0]},
                                {"*SENSOR_DEFINE_NODE\n{},6,2,0,,VEL\n", (v(x6) - v(x2)).norm()},
                                {"*SENSOR_DEFINE_NODE\n{},6,2,7,,VEL\n", (v(x6) - v(x2)).dot(d)},
                                {"*SENSOR_DEFINE_NODE\n{},2,0,Z,,VEL\n", v(x2)[2]},
                                {"*SENSOR_DEFINE_NODE_SET\n{},2,1,X,,COORD,AVG\n", 0.45},
                                {"*SENSOR_DEFINE_NODE_SET\n{},2,1,X,,COORD,SUM\n", 1.8},
                                {"*SENSOR_DEFINE_NODE_SET\n{},2,0,Z,,VEL,MAX\n", 6},
                                {"*SENSOR_DEFINE_NODE_SET\n{},2,0,Z,,VEL,MIN\n", 4.5},
                                {"*SENSOR_DEFINE_MISC\n{},TIME\n", 0.05},
                                {"*SENSOR_DEFINE_MISC\n{},CURVE,6\n", 10.2},
                                {"*SENSOR_DEFINE_FORCE\n{},SPC,41,X\n", of_support * 3},
                                {"*SENSOR_DEFINE_FORCE\n{},SPC,41,Y\n", 0},
                                {"*SENSOR_DEFINE_FORCE\n{},SPC,41,M\n", two * std::hypot(3, 7)},
                                {"*SENSOR_DEFINE_FORCE\n{},SPC,41,7\n", of_support * 0.8 * 7},
                                {"*SENSOR_DEFINE_FORCE\n{},SPC,41,YMOMENT\n", of_support * 0.5},
                                {"*SENSOR_DEFINE_FORCE\n{},SPC,41,MMOMENT\n", two * 0.5},
                                {"*SENSOR_DEFINE_FORCE\n{},PRESC-MOT,31,Y\n", -5},
                                {"*SENSOR_DEFINE_FORCE\n{},PRESC-MOT,31,X\n", 0},
                                {"*SENSOR_DEFINE_FORCE\n{},PRESC-MOT,32,ZMOMENT\n", -0.7}};
  std::string sensors, switches;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    std::string card = cases[k].card;
    sensors += card.replace(card.find("{}"), 2, std::to_string(k + 1));
    switches += fmt::format("*SENSOR_SWITCH\n{0},SENSOR,{0},GT,{1}\n", k + 1, cases[k].value + 1e-3);
    switches += fmt::format("*SENSOR_SWITCH\n{},,{},LT,{}\n", k + 101, k + 1, cases[k].value + 1e-3);
  }
  auto s = simulation_of(plate(sensors, switches));
  ASSERT_NE(s, nullptr);
  const auto* board = s->world().passes.all<const SensorBoard>().at(0);
  for (int k = 0; k < 5; ++k) s->step(test::do_nothing);
  std::map<Id, Real> found;
  s->step([&](World& world, const Clock& clock, const std::string&) {
    for (const Sensor& sensor : board->sensors())
      if (cases[static_cast<std::size_t>(sensor.id) - 1].card.find("_NODE") == std::string::npos)
        found[sensor.id] = sensor.value(world, clock);
    const Vec x[] = {Vec(0, 0, 0), x2, Vec(0.6, 0, 0), x4, Vec(0.3, 0.2, 0), x6};
    for (Index n = 0; n < 6; ++n) world.nodes.x.set(n, x[n]), world.nodes.v.set(n, v(x[n]));
    for (const Sensor& sensor : board->sensors())
      if (!found.contains(sensor.id)) found[sensor.id] = sensor.value(world, clock);
  });
  ASSERT_EQ(found.size(), cases.size());
  for (std::size_t k = 0; k < cases.size(); ++k)
    // loads move the heavy nodes by 1e-9, and what drives a node is of forces of the step
    EXPECT_NEAR(found[static_cast<Id>(k) + 1], cases[k].value, 1e-6) << cases[k].card;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    EXPECT_GE(board->find_switch(static_cast<Id>(k) + 1), 0);
    EXPECT_GE(board->find_switch(static_cast<Id>(k) + 101), 0);
  }
  EXPECT_EQ(board->find_switch(99), -1);
}

// Each switch that is on makes the next change; after the last one it ends, or begins again NREP times.
TEST(SensorCards, ControlsGoThroughTheirSwitches) {
  for (const int repeats : {0, 1, -1})
    for (const bool on_first : {false, true}) {
      std::vector<SensorSwitch> switches(2);
      std::vector<Sensor> sensors(2);
      std::array<Real, 2> measured{};
      for (int k = 0; k < 2; ++k) {
        auto& one = switches[static_cast<std::size_t>(k)];
        one.id = 10 + k, one.sensor = k, one.greater = k == 0, one.value = k == 0 ? 1 : -1;
        sensors[static_cast<std::size_t>(k)].value = [&measured, k](const World&, const Clock&) {
          return measured[static_cast<std::size_t>(k)];
        };
      }
      SensorControl control{.id = 3, .kind = SensorControl::Of::contact, .controlled = 5};
      control.on_first = on_first, control.switches = {0, 1}, control.repeats = repeats;
      SensorBoard board(sensors, switches, {control});
      EXPECT_EQ(board.control_of(SensorControl::Of::contact, 5), 0);
      EXPECT_EQ(board.control_of(SensorControl::Of::motion, 5), -1);
      EXPECT_EQ(board.control_of(SensorControl::Of::contact, 0), -1);
      EXPECT_FALSE(board.controls()[0].claimed);
      EXPECT_FALSE(board.gate_of_contact(4).there());
      const SensorGate gate = board.gate_of_contact(5);
      EXPECT_TRUE(gate.there() && board.controls()[0].claimed);
      World world;
      Clock clock;
      const auto after = [&](Real first, Real second) {
        measured = {first, second}, ++clock.cycle, clock.t += 1;
        board.strike(world, clock);
        EXPECT_EQ(board.control_is_on(0), gate.open());
        return gate.open() != on_first;  // it has changed an odd number of times
      };
      EXPECT_FALSE(after(0, 0));
      EXPECT_FALSE(after(1, -2)) << "1 is not above 1, and it is not the turn of the second";
      EXPECT_TRUE(after(1.1, 0));
      EXPECT_TRUE(board.switch_is_on(0));
      EXPECT_FALSE(board.switch_is_on(1));
      EXPECT_TRUE(after(1.1, -1)) << "-1 is not below -1";
      EXPECT_FALSE(after(0, -1.1));
      EXPECT_EQ(after(2, 0), repeats != 0);
      EXPECT_FALSE(after(0, -2));
      EXPECT_EQ(after(2, 0), repeats < 0);
      measured = {3, 0};
      EXPECT_EQ(board.text_of_switch(0, world, clock), "switch 10: sensor 0 measures 3, above 1");
      EXPECT_EQ(board.text_of_switch(1, world, clock), "switch 11: sensor 0 measures 0, below -1");
    }
}

// Refused by name where nothing exerts the force that is measured, and where a vector has no direction.
TEST(SensorCards, WhatIsNotThereIsRefused) {
  const auto refusal = [](const std::string& card) {
    Diagnostics diagnostics;
    ReadOptions options;
    const std::string text = plate(card, "*SENSOR_SWITCH\n1,SENSOR,1,GT,1.0\n");
    options.open = [text](const std::string&) { return text; };
    const auto s = Simulation::build("test.k", options, diagnostics);
    return s ? "" : diagnostics.text();
  };
  EXPECT_EQ(refusal("*SENSOR_DEFINE_FORCE\n1,SPC,41,X\n"), "");
  EXPECT_NE(refusal("*SENSOR_DEFINE_FORCE\n1,SPC,42,X\n").find("nothing that exerts such a force"),
            std::string::npos);
  EXPECT_NE(refusal("*SENSOR_DEFINE_FORCE\n1,PRESC-MOT,33,X\n").find("nothing that exerts such a force"),
            std::string::npos);
  EXPECT_NE(refusal("*DEFINE_VECTOR\n9,1.0,1.0,1.0,1.0,1.0,1.0\n*SENSOR_DEFINE_FORCE\n1,SPC,41,9\n")
                .find("vector 9"),
            std::string::npos);
  EXPECT_NE(refusal("*SENSOR_DEFINE_FORCE\n1,SPC,41,W\n").find("vector W does not exist"), std::string::npos);
}

}  // namespace sensor_cards_test
