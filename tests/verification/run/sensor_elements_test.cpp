// Sensors of elements, springs, rigid walls and cross sections: when they switch, against what is exact.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "loads/sensors/sensors.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;

namespace {

constexpr Real pull_speed = 0.5,
               young = 1e6;  // with which they are stretched [L/T], and Young's modulus [M/LT2]

/// A cube of one solid, a shell, two beams and a spring, all of length 1, that one motion stretches along x:
/// cube 1 to 8, shell 11 to 14, beams 21 to 23 with a third node, spring 31 and 32. Without lateral strain.
std::string stretched(const std::string& cards, const std::string& solid_material = "") {
  std::string nodes, moving = "*SET_NODE_LIST\n1\n";
  const auto node = [&](int id, Real x, Real y, Real z, const char* codes) {
    nodes += fmt::format("{},{},{},{}{}\n", id, x, y, z, codes);
    if (x == 1) moving += fmt::format("{}\n", id);
  };
  for (int k = 0; k < 8; ++k) {
    const int i = k % 4 == 1 || k % 4 == 2, j = k % 4 >= 2;
    node(k + 1, i, j, k / 4, i == 0 ? ",1" : "");
    if (k < 4) node(k + 11, i, j, 5, i == 0 ? ",7,7" : ",5,7");
  }
  for (int k = 0; k < 3; ++k) node(21 + k, k == 2 ? 1 : 0.5 * k, 8, 0, k == 0 ? ",7,7" : ",5,7");
  node(29, 0.5, 9, 0, ",7,7");
  node(31, 0, 12, 0, ",7"), node(32, 1, 12, 0, ",5");
  const std::string material =
      solid_material.empty() ? fmt::format("*MAT_ELASTIC\n1,1.0,{},0.0\n", young) : solid_material;
  return fmt::format("*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*CONTROL_TIMESTEP\n0.0,0.5\n") + material +
         fmt::format("*MAT_ELASTIC\n2,1.0,{},0.0\n", young) +
         "*PART\ncube\n1,1,1\n*PART\nshell\n2,2,2\n*PART\nbeams\n3,3,2\n*PART\nspring\n4,4,4\n"
         "*SECTION_SOLID\n1,1\n*SECTION_SHELL\n2,2,1.0,3\n0.1,0.1,0.1,0.1\n*SECTION_BEAM\n3,1,1.0,2,0\n"
         "0.1,0.1,0.1,0.1\n*SECTION_DISCRETE\n4,0\n\n*MAT_SPRING_ELASTIC\n4,200.0\n*ELEMENT_MASS\n"
         "       9      32             1.0\n"
         "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n*ELEMENT_SHELL\n1,2,11,12,13,14\n"
         "*ELEMENT_BEAM\n1,3,21,22,29\n2,3,22,23,29\n*ELEMENT_DISCRETE\n1,4,31,32\n" +
         moving +
         fmt::format("*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,0,1\n*DEFINE_CURVE\n1\n0.0,{0}\n9.0,{0}\n",
                     pull_speed) +
         "*NODE\n" + nodes + cards + "*END\n";
}
bool is_on(const Simulation& s, Id id) {
  const SensorBoard* board = s.world().passes.all<SensorBoard>().front();
  return board->switch_is_on(board->find_switch(id));
}
/// The first time at which a switch is on.
Real switched_at(Simulation& s, Id id, Real until = 0.9) {
  while (s.clock().t < until) {
    const Real t = s.clock().t;
    s.step(do_nothing);
    if (is_on(s, id)) return t;
  }
  return -1;
}
std::string measure(const std::string& sensor, const std::string& value, const std::string& set = "") {
  return "*SENSOR_DEFINE_" + sensor + "\n" + set + "*SENSOR_SWITCH\n1,SENSOR,1,GT," + value + "\n";
}
/// Of a stress young ln(1 + v t).
Real time_of_stress(Real stress) {
  return (std::exp(stress / young) - 1) / pull_speed;
}

}  // namespace

TEST(SensorElements, StressesSwitchInTime) {
  const Real sigma = 1e5, at = time_of_stress(sigma);
  const std::string value = "1.0E5";
  const std::string solid = "ELEMENT\n1,SOLID,1,XX,STRESS", shell = "ELEMENT\n1,SHELL,1,XX,STRESS,TOP";
  for (const auto& [cards, time] :
       {std::pair(measure(solid, value), at), std::pair(measure(shell, value), at),
        std::pair(measure(solid + ",,0.5", value), time_of_stress(2 * sigma)),
        std::pair("*SET_SOLID\n5\n1\n" + measure("ELEMENT_SET\n1,SOLID,5,XX,STRESS", value, "MAX\n"), at),
        std::pair("*SET_BEAM\n6\n1,2\n" + measure("ELEMENT_SET\n1,BEAM,6,AXIAL,FORCE", "2000.0", "SUM\n"),
                  at),
        // A 1e-2
        std::pair(measure("ELEMENT\n1,BEAM,2,AXIAL,FORCE", "1000.0"), at),
        std::pair(
            "*DATABASE_CROSS_SECTION_PLANE_ID\n3,cut\n0,0.5,-0.1,-0.1,1.5,-0.1,-0.1\n0.5,1.0,-0.1,1.2,1.2\n" +
                measure("FORCE\n1,XSECTION,3,X", value),
            at)}) {
    auto s = simulation_of(stretched(cards));
    ASSERT_NE(s, nullptr) << cards;
    const Real seen = switched_at(*s, 1);
    EXPECT_NEAR(seen / time, 1, 0.01) << cards;
  }
}

TEST(SensorElements, SpringsSwitchInTime) {
  for (const auto& [cards, time] :
       {std::pair(measure("ELEMENT\n1,DISC-ELE,1,,FORCE", "20.0"), 0.1 / pull_speed),
        std::pair(measure("ELEMENT\n1,DISC-ELE,1,,DLEN", "0.2"), 0.2 / pull_speed)}) {
    auto s = simulation_of(stretched(cards));
    ASSERT_NE(s, nullptr);
    EXPECT_NEAR(switched_at(*s, 1), time, 2e-3);
  }
}

// A shell that a rotation of 1 rad/s bends about y: its upper point, sqrt(0.6) of half the thickness up, is
// pulled with E t z, and its lower one pressed.
TEST(SensorElements, LayersOfAShellDiffer) {
  for (const auto& [layer, sign] : {std::pair("TOP", 1.0), std::pair("BOT", -1.0)}) {
    const std::string text =
        fmt::format(
            "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*PART\nshell\n2,2,2\n*SECTION_SHELL\n2,2,1.0,3\n0.1,0.1,0."
            "1,0.1\n"
            "*MAT_ELASTIC\n2,1.0,{},0.0\n*ELEMENT_SHELL\n1,2,11,12,13,14\n*NODE\n11,0.0,0.0,0.0,7,7\n12,1.0,"
            "0.0,0.0,"
            "7,6\n13,1.0,1.0,0.0,7,6\n14,0.0,1.0,0.0,7,7\n*SET_NODE_LIST\n1\n12,13\n"
            "*BOUNDARY_PRESCRIBED_MOTION_SET\n1,6,0,1,{}\n*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n",
            young, sign) +
        measure(fmt::format("ELEMENT\n1,SHELL,1,XX,STRESS,{}", layer), "3000.0") + "*END\n";
    auto s = simulation_of(text);
    ASSERT_NE(s, nullptr);
    EXPECT_NEAR(switched_at(*s, 1) / (3000 / (young * std::sqrt(0.6) * 0.05)), 1, 0.02) << layer;
  }
}

// A cantilever along x of two beams of length 0.5, s along y: a load that grows slowly along z (t) or y (s)
// is the shear force in each, and has the moment of the arm in the middle of the first.
TEST(SensorElements, BeamsTellShearAndMoments) {
  struct Case {
    int dof;
    const char* sensor;
    Real sign, arm;
  };
  for (const Case& one : {Case{3, "1,BEAM,1,SHEART,FORCE", 1, 1}, Case{3, "1,BEAM,1,SHEARS,MOMENT", -1, 0.75},
                          Case{2, "1,BEAM,1,SHEARS,FORCE", 1, 1}, Case{2, "1,BEAM,1,SHEART,MOMENT", 1, 0.75},
                          Case{5, "1,BEAM,2,AXIAL,MOMENT", 1, 1}}) {
    const std::string text =
        "*KEYWORD\n*CONTROL_TERMINATION\n9.0\n*PART\nbeams\n3,3,2\n*SECTION_BEAM\n3,1,1.0,2,0\n0.1,0.1,0.1,0."
        "1\n"
        "*MAT_ELASTIC\n2,1.0,1.0E6,0.3\n*NODE\n1,0.0,0.0,0.0,7,7\n2,0.5,0.0,0.0\n3,1.0,0.0,0.0\n9,0.5,9.0,0."
        "0,7,"
        "7\n*ELEMENT_BEAM\n1,3,1,2,9\n2,3,2,3,9\n*DAMPING_GLOBAL\n0,20.0\n*DEFINE_CURVE\n1\n0.0,0.0\n9.0,0."
        "9\n" +
        fmt::format("*LOAD_NODE_POINT\n3,{},1,{}\n", one.dof, one.sign) +
        measure("ELEMENT\n" + std::string(one.sensor), fmt::format("{}", 0.4 * one.arm)) + "*END\n";
    auto s = simulation_of(text);
    ASSERT_NE(s, nullptr);
    EXPECT_NEAR(switched_at(*s, 1, 8), 4, 0.08) << one.sensor;
  }
}

// A plastic strain of ln(1 + v t) - SIGY/young = 0.2 deletes the cube, and the run ends.
TEST(SensorElements, FailureSwitches) {
  const std::string material = "*MAT_PLASTIC_KINEMATIC\n1,1.0,1.0E6,0.0,1.0E4,0.0,0.0\n0.0,0.0,0.2\n";
  auto s = simulation_of(stretched(measure("ELEMENT\n1,SOLID,1,,FAIL", "0.5"), material));
  ASSERT_NE(s, nullptr);
  const Real seen = switched_at(*s, 1);
  // plastic flow is without change of volume, so that the cube would thin: what is exact is that it is
  // deleted
  Index deleted = 0;
  for (const auto& group : s->world().groups)
    if (const auto* eroded = dynamic_cast<const Field<Index>*>(group->fields.find("eroded")))
      for (Index e = 0; e < group->size(); ++e) deleted += (*eroded)[e] != 0;
  EXPECT_EQ(deleted, 1);
  EXPECT_NEAR(seen, (std::exp(0.21) - 1) / pull_speed, 0.02 / pull_speed);
}

/// A cube of mass 1 with the speed 2.
const std::string cube_in_flight =
    "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,1."
    "0E6,"
    "0.0\n*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n*NODE\n1,0.0,0.0,0.0\n2,1.0,0.0,0.0\n3,1.0,1.0,0.0\n4,0.0,1."
    "0,"
    "0.0\n5,0.0,0.0,1.0\n6,1.0,0.0,1.0\n7,1.0,1.0,1.0\n8,0.0,1.0,1.0\n*INITIAL_VELOCITY\n0\n2.0\n";

// A cube of mass 1 that hits a wall at 0.2 after 0.1: it is stopped within a step, at v m/dt.
TEST(SensorElements, RigidWallsSwitch) {
  const std::string text = cube_in_flight + "*RIGIDWALL_PLANAR_ID\n7\n0\n1.2,0.0,0.0,0.0,0.0,0.0\n" +
                           measure("FORCE\n1,RWALL,7,X", "1.0") + "*END\n";
  auto s = simulation_of(text);
  ASSERT_NE(s, nullptr);
  const Real seen = switched_at(*s, 1, 0.3);
  EXPECT_NEAR(seen, 0.1, 3 * s->clock().dt_old);  // the force is that of the step before
  EXPECT_GT(seen, 0.1 - s->clock().dt_old);
}

TEST(SensorElements, AreRefusedByName) {
  const auto faults = [](const std::string& cards) {
    Diagnostics diagnostics;
    ReadOptions options;
    const std::string text = stretched(cards);
    options.open = [text](const std::string&) { return text; };
    Simulation::build("test.k", options, diagnostics);
    return diagnostics.text();
  };
  const auto expect = [&](const std::string& cards, const char* message) {
    EXPECT_NE(faults(cards).find(message), std::string::npos) << message << "\n" << faults(cards);
  };
  expect(measure("ELEMENT\n1,SOLID,1,XX", "1.0"), "'STRAIN (blank)' is not supported");
  expect(measure("ELEMENT\n1,SOLID,9,XX,STRESS", "1.0"), "solid 9 does not exist");
  expect(measure("ELEMENT\n1,BEAM,1,XX,FORCE", "1.0"), "'XX' is not supported");
  expect(measure("ELEMENT\n1,TSHELL,1,XX,STRESS", "1.0"), "'TSHELL' is not supported");
  expect(measure("ELEMENT\n1,SHELL,1,XX,STRESS,MID", "1.0"), "'MID' is not supported");
  expect("*SET_SOLID\n5\n1\n" + measure("ELEMENT_SET\n1,SOLID,5,XX,STRESS", "1.0", "\n"),
         "'blank' is not supported");
  expect(measure("ELEMENT\n1,DISC-ELE,7,,FORCE", "1.0"), "nothing that exerts such a force has this number");
  expect(measure("FORCE\n1,RWALL,7,X", "1.0"), "nothing that exerts such a force has this number");
  expect(measure("FORCE\n1,AIRBAG,7,X", "1.0"), "by which nothing can be switched");
}

// The force of the wall is that of the step before, also over a restart.
TEST(SensorElements, HaveTheSameBitsOverARestart) {
  const std::string text =
      cube_in_flight +
      "*BOUNDARY_PRESCRIBED_MOTION_NODE_ID\n5,drive\n1,2,0,1\n*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n"
      "*SENSOR_CONTROL\n1,PRESC-MOT,5\nOFF,1\n"
      "*RIGIDWALL_PLANAR_ID\n7\n0\n1.02,0.0,0.0,0.0,0.0,0.0\n" +
      measure("FORCE\n1,RWALL,7,X", "1.0") + "*END\n";
  auto s = simulation_of(text);
  int steps = 0;
  while (switched_at(*s, 1, s->clock().t + 1e-9) < 0 && steps < 1000) ++steps;
  ASSERT_LT(steps, 1000);
  test::expect_same_bits(text, steps + 20, steps);
}
