// What structures keep over a restart, scene by scene: each number matters, and none is left out.
#include <gtest/gtest.h>

#include <array>
#include <sstream>

#include "beam_decks.hpp"
#include "joint_decks.hpp"
#include "restart_walk.hpp"
#include "shell_decks.hpp"

using namespace courant;
using test::JointDeck;
using test::ShellDeck;
using test::SolidDeck;
using test::beams::BeamDeck;

namespace restart_scenes_test {
namespace {

struct Scene {
  std::string deck;
  std::vector<int> saved_at;  ///< steps; bits are compared after a restart from the last of them
  int steps = 0;
  std::vector<std::array<std::string, 2>> matter;  ///< group, and names of numbers that are to be noticed
};

void expect_all_to_matter(const Scene& scene) {
  const test::Walked walked = test::walk(scene.deck, scene.saved_at, scene.steps);
  for (const auto& [group, names] : scene.matter) {
    std::istringstream all(names);
    for (std::string name; all >> name;) EXPECT_TRUE(walked.noticed.contains(group + name)) << group << name;
  }
  for (const int at : scene.saved_at) test::expect_same_bits(scene.deck, scene.steps, at);
}

const std::string elastic = "*SECTION_SOLID\n1,1\n*PART\nsoft\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1e7,0.3\n";

/// A driven wheel, an arm with friction, stops and a damper at its hinge, and a hub that a motor speeds up.
std::string driven_joints() {
  JointDeck deck;
  const int ground = deck.ground(), wheel = deck.body({.x = {0, 0, 1}}),
            arm = deck.body({.x = {1, 0, 0},
                             .J = Vec(0.05, 0.08, 0.06).asDiagonal(),
                             .v = {0, 0, -2},
                             .omega = {0, 2, 0}}),
            hub = deck.body({.x = {0, 0, 2}, .m = 0.2, .omega = {0, 0, 0.5}});
  deck.joint("REVOLUTE", ground, arm, {Vec(0, 0, 0), Vec(0, 1, 0)});
  deck.joint("SPHERICAL", ground, wheel, {Vec(0, 0.2, 1)});
  deck.joint("REVOLUTE", wheel, hub, {Vec(0, 0, 2), Vec(0, 0, 3)});
  deck.motor("ROTATIONAL", wheel, hub, {0, 0, 2}, Vec(0, 0, 1), 8, 1);
  deck.curve(8, "0.0,1.0\n0.3,-4.0\n9.0,2.0\n");
  deck.curve(9, "-100.0,-20.0\n100.0,20.0\n");
  deck.curve(10, "0.0,1.0\n9.0,9.0\n");
  deck.more += fmt::format(
      "*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED\n1,{},{}\n0,0,0,0,9\n0,0,100.0,0.1\n0,0,-60.0,30.0\n"
      "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{},7,0,10\n",
      ground, arm, wheel);
  deck.gravity(9.81);
  return deck.text(2);
}

/// A block between a plate that a curve drives and a moving one with a mass, both with friction.
std::string block_between_walls() {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 2, 2, 2, 1);
  deck.cards =
      elastic +
      "*RIGIDWALL_GEOMETRIC_FLAT_MOTION_ID\n5,driven\n0\n0.1,0.1,-0.0005,0.1,0.1,1.0,0.3\n\n4,1,0.6,0.0,0.8\n"
      "*DEFINE_CURVE\n4\n0.0,0.0\n0.01,0.05\n9.0,0.06\n"
      "*RIGIDWALL_PLANAR_MOVING_ID\n6,thrown\n0\n0.1,0.1,0.201,0.1,0.1,-0.799,0.2\n5.0,1.0\n"
      "*INITIAL_VELOCITY\n0\n0.5,0.2,-0.5\n";
  return deck.text(1);
}

/// A rod that slides over another, across or beside it.
std::string rubbing_rods(Real angle) {
  BeamDeck deck;
  deck.part(1, test::beams::square_1, test::beams::steel_of_beams);
  const Real r = std::sqrt(1e-4 / pi), turn = angle * pi / 180;
  const auto rod = [&](const Vec& from, const Vec& to) {
    const int n = 4, first = deck.node + 1;
    for (int k = 0; k <= n; ++k) deck.at(from + (to - from) * k / n);
    const int third = deck.at(0.5 * (from + to) + (to - from).unitOrthogonal(), ",7,7");
    for (int k = 0; k < n; ++k) deck.beam(1, first + k, first + k + 1, third);
    return first;
  };
  const Vec off(0.01, 0.001, 0), up(0, 0, 2 * r + 2e-5), along(std::cos(turn), std::sin(turn), 0);
  rod(Vec(-0.1, 0, 0) + off + up, Vec(0.1, 0, 0) + off + up);
  const int second = rod(-0.1 * along, 0.1 * along);
  deck.velocity([&](int k) { return k < second - 1 ? Vec(3, 5, -20) : Vec(Vec::Zero()); });
  deck.cards += "*CONTACT_AUTOMATIC_GENERAL_ID\n3,rods\n0\n0.2,0.2,,,10.0\n1.0\n";
  return deck.text(1);
}

/// Two cubes, glued with damage, drawn apart and aside; OPTION 3 also holds what touches later.
std::string glued_cubes(const std::string& contact, const Vec& v, Real gap = 0) {
  SolidDeck deck;
  deck.block(Vec(1, 1, 1), 2, 2, 2, 1);
  deck.block(Vec(1, 1, 1), 3, 3, 3, 2, [&](const Vec& x) { return Vec(x + Vec(0, 0, 1 + gap)); });
  deck.cards =
      "*SECTION_SOLID\n1,1\n*PART\nbelow\n1,1,1\n*PART\nabove\n2,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E9,0.3\n"
      "*CONTROL_HOURGLASS\n4,0.05\n" +
      contact + fmt::format("*INITIAL_VELOCITY\n1\n{},{},{}\n", v[0], v[1], v[2]);
  deck.node_set(1, [&](const Vec& x) { return x[2] > 1 + 0.5 * gap + 1e-6; });
  return deck.text(10);
}

/// A block that is rigid for a while and again, then on its own.
std::string switched_block() {
  SolidDeck deck;
  deck.block(Vec(0.5, 0.3, 0.2), 3, 2, 2, 1);
  const auto one = [](int number, const std::string& when, bool rigid) {
    return fmt::format("*DEFORMABLE_TO_RIGID_AUTOMATIC\n{},{}\n0,0,0,0.001,{},{}\n{}\n", number, when,
                       int(rigid), int(!rigid), rigid ? "1,0,PART" : "1,PART");
  };
  deck.cards = elastic +
               "*SET_NODE_LIST_GENERATE\n1\n1,1000\n*INITIAL_VELOCITY_GENERATION\n1,2,3.0,1.0,0.0,0.0\n"
               "0.0,0.0,0.0,0.3,0.2,1.0\n" +
               one(1, "0,0.01,0.0,0.02", true) + one(2, "0,0.02,0.0,0.02", false);
  return deck.text(1);
}

/// A bumper that dies and lets go, with a time of its own; later another is born.
std::string contacts_in_turn() {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 2, 2, 2, 1);
  deck.block(Vec(0.4, 0.4, 0.1), 2, 2, 1, 2, [](const Vec& x) { return Vec(x - Vec(0.1, 0.1, 0.1005)); });
  deck.cards = elastic +
               "*PART\nfloor\n2,1,1\n*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID\n7,first\n1,2,3,3\n"
               "0.3,0.2,5.0,,20.0,,0.0,4.0e-3\n\n1,0.1\n"
               "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID\n8,second\n1,2,3,3\n0.0,,,,,,5.0e-3\n\n"
               "*INITIAL_VELOCITY\n1\n1.0,0.2,-1.0\n";
  deck.node_set(1, [](const Vec& x) { return x[2] > -1e-9; });
  return deck.text(1);
}

/// All elements are deleted at a time; what is left goes on.
std::string all_deleted() {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 2, 2, 2, 1);
  deck.cards = elastic +
               "*MAT_ADD_EROSION\n1\n0.0,0.0,0.0,0.0,0.0,0.0,0.0,2.0e-3\n*CONTROL_TIMESTEP\n0.0,0.5\n"
               "*INITIAL_VELOCITY\n1\n-20.0,0.0,0.0\n";
  deck.node_set(1, [](const Vec& x) { return x[0] > 0.1 + 1e-9; });
  return deck.text(1);
}

/// A row of discrete beams that yield, spot welds with a mean over steps, a cable that is preloaded, a top.
std::string lines_of_all_kinds() {
  BeamDeck deck;
  for (int line = 0; line < 3; ++line)
    for (int k = 0; k < 5; ++k) deck.at({0.1 * k, 0.3 * line, 0.01 * k}, k == 0 ? ",7,7" : "");
  for (int k = 1; k < 5; ++k)
    deck.beam(1, k, k + 1), deck.beam(2, k + 5, k + 6), deck.beam(3, k + 10, k + 11);
  deck.cards =
      "*PART\ndiscrete\n1,1,1\n*SECTION_BEAM\n1,6,,,,-2\n0.01,0.4,0,,,0,0,0\n*MAT_068\n1,2.0,1000.0,2000.0,"
      "3000.0,20.0,40.0,60.0\n"
      "0.5,0.5,0.5,0.1,0.1,0.1\n1,1,1,1,1,1\n0.0\n0.0,0.0,0.0,1.5\n0.3,0.3\n*DEFINE_CURVE\n1\n0.0,0.5\n1.0,2."
      "0\n"
      "*PART\nwelds\n2,2,2\n*SECTION_BEAM\n2,9,1.0\n0.005,0.005\n*MAT_SPOTWELD\n2,7800.0,1e6,0.3,2e3,1e4,,\n,"
      "5.0,,,,,,5.0\n"
      "*PART\ncable\n3,3,3\n*SECTION_BEAM\n3,6\n1.0E-4,0.0,0,1.0E-4,0.0\n*MAT_CABLE_DISCRETE_BEAM\n3,7850.0,"
      "1e6,0,1.0,2.0E-3,1.0E-3,1\n"
      "0,0.0,0.0,0.0,20.0\n";
  deck.velocity([](int n) { return Vec(0.3 * n, std::sin(n), 0.5 - 0.1 * n); });
  return deck.text(100);
}

/// A plate that folds, yields and tears, some of whose nodes are driven, others loaded; mass is added.
std::string torn_plate() {
  ShellDeck deck;
  deck.plate(1, 0.8, 6, 5, 1);
  deck.part(
      1, 0.01,
      "*MAT_PLASTIC_KINEMATIC\n1,7850.0,2.1E+11,0.3,2.0E8,1.0E9,0.3\n0.0,0.0,0.02\n*MAT_ADD_EROSION\n1\n"
      "0.0,0.0,0.0,0.9\n0.0,0.0,0.0,4.0e8,1.0e14\n",
      3);
  deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9; });
  deck.node_set(2, [](const Vec& x) { return x[0] > 1 - 1e-9; });
  deck.velocity([](const Vec& x) { return Vec(60 * x[0] * x[1], -3, 90 * x[0] * x[0]); });
  deck.cards +=
      "*HOURGLASS\n1,5\n*CONTROL_HOURGLASS\n4,0.05\n*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,-2.6e-5\n"
      "*BOUNDARY_PRESCRIBED_MOTION_SET\n2,3,0,9\n2,5,0,9\n*DEFINE_CURVE\n9\n0.0,90.0\n1.0,0.0\n"
      "*DATABASE_BNDOUT\n1.0e-4\n";
  return deck.text(1);
}

}  // namespace

TEST(RestartScenes, DrivenBodiesAndJoints) {
  expect_all_to_matter({driven_joints(),
                        {150},
                        200,
                        {{"passes/joint stiffness/", "state"},
                         {"passes/joints/", "turned"},
                         {"passes/rigid bodies/part 1/", "L drive_work omega q v x"},
                         {"passes/rigid bodies/part 2/", "L drive_work omega q v x"},
                         {"passes/rigid bodies/part 3/", "L drive_work omega q v x"},
                         {"passes/rigid bodies/part 4/", "L drive_work omega q v x"}}});
}
// Sensors look before joints pull: at the force of the step before.
TEST(RestartScenes, ForcesOfJointsThatSensorsMeasure) {
  constexpr int at = 60;
  const auto deck = [](Real limit) {
    JointDeck out;
    const int ground = out.ground(), arm = out.body({.x = {0.5, 0, 0}, .omega = {0, 2, 0}});
    out.joint("LOCKING", ground, arm, {Vec(0, 0, 0), Vec(0, 1, 0), Vec(1, 0, 0)});
    out.gravity(9.81);
    out.more += "*SENSOR_DEFINE_FORCE\n1,JOINT,1,M\n2,JOINT,1,MMOMENT\n*SENSOR_SWITCH\n";
    for (const int sensor : {1, 2})
      for (const Real part : {0.5, 1.05})
        out.more += fmt::format("{},SENSOR,{},GT,{:.9g}\n", 10 * sensor + (part > 1), sensor,
                                part * (sensor == 1 ? 9.81 : 0.5 * 9.81) * limit);
    return out.text(1);
  };
  expect_all_to_matter(
      {deck(1), {at}, at + 1, {{"passes/joints/", "force moment"}, {"passes/sensors/", "holds_since"}}});
}
TEST(RestartScenes, WallsThatMove) {
  expect_all_to_matter({block_between_walls(),
                        {10, 40},
                        60,
                        {{"passes/rigid wall 5/", "impulse lost moved speed way"},
                         {"passes/rigid wall 6/", "impulse lost moved speed way"}}});
}
TEST(RestartScenes, EdgesThatRub) {
  for (const Real angle : {90.0, 5.0})
    expect_all_to_matter(
        {rubbing_rods(angle),
         {12, 25},
         40,
         {{"passes/contact 3 of edges/",
           "damping_work friction_work normals_friction pairs soft_dt stiffness_slack_energy"},
          {"passes/contact 3 of edges/", angle < 45 ? "springs" : ""}}});
}
TEST(RestartScenes, TiesWithDamage) {
  expect_all_to_matter(
      {glued_cubes("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK_ID\n7,glue\n2,1,3,3\n\n10.0,10.0\n"
                   "6,10000.0,100.0,0.001\n",
                   Vec(1, 0, 1)),
       {20, 60},
       80,
       {{"passes/contact 7 of nodes/", "damping_work friction_work soft_dt"},
        {"passes/tied contact 8/", "broken lost lost_so_far onset over widest"}}});
}
TEST(RestartScenes, TiesThatEnd) {
  expect_all_to_matter(
      {glued_cubes("*CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET_ID\n7,glue\n2,1,3,3\n,,,,,,,3.0e-3\n10.0,10.0\n",
                   Vec(1, 0, 1)),
       {10, 40},
       60,
       {{"passes/tied contact 7/", "broken lost lost_so_far"}}});
}
TEST(RestartScenes, TiesThatComeLater) {
  expect_all_to_matter(
      {glued_cubes("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK_ID\n7,glue\n2,1,3,3\n\n1.0,1.0\n1\n",
                   Vec(1, 0, -10), 0.04),
       {60, 80},
       100,
       {{"passes/contact 7 of nodes/", "damping_work fresh friction_work soft_dt"},
        {"passes/tied contact 8/",
         "broken later_nodes later_numbers limit limit_known limit_of lost lost_so_far over"}}});
}
TEST(RestartScenes, PartsThatAreRigidForAWhile) {
  expect_all_to_matter(
      {switched_block(),
       {20, 30, 60},
       90,
       {{"passes/parts that are rigid for a while/", "blocked_until longest"},
        {"passes/parts that are rigid for a while/acted ", "0 1"},
        {"passes/parts that are rigid for a while/body 0/", "L active inertia mass omega places q v x"}}});
}
TEST(RestartScenes, ContactsInTurn) {
  expect_all_to_matter({contacts_in_turn(),
                        {10, 30, 60},
                        90,
                        {{"passes/contact 7 of nodes/", "damping_work friction_work soft_dt"},
                         {"passes/contact 8 of nodes/", "damping_work fresh friction_work soft_dt"}}});
}
TEST(RestartScenes, NothingLeft) {
  expect_all_to_matter(
      {all_deleted(), {10, 60}, 80, {{"passes/deleted elements/", "first_step longest_step"}}});
}
TEST(RestartScenes, LinesOfAllKinds) {
  expect_all_to_matter(
      {lines_of_all_kinds(),
       {20, 50},
       70,
       {{"passes/deleted elements/", "first_step longest_step"},
        {"passes/guard/", "initial_internal initial_potential initial_size"},
        {"passes/guard/part 1/", "c0 seen"},
        {"passes/guard/part 1/density_high/", "particle t value"},
        {"passes/guard/part 1/density_low/", "particle t value"},
        {"passes/guard/part 1/speed/", "particle t value"},
        {"passes/stepper/",
         "first_dt first_tssfac steady_dt steady_least steady_left steady_target steady_who"},
        {"passes/total momentum/", "began change first mass most"}}});
}
TEST(RestartScenes, APlateThatTears) {
  expect_all_to_matter(
      {torn_plate(), {20, 60}, 80, {{"passes/deleted elements/", "first_step longest_step"}}});
}

}  // namespace restart_scenes_test
