// What decks of crash models ask for beside their physics: thickness, deletion, accelerometers, loads on
// bodies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "base/run_error.hpp"
#include "elements/shell/shells.hpp"
#include "solid_decks.hpp"
#include "state/ending.hpp"
#include "state/reports.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::start_ledger;

namespace {

/// A square shell of side 1 and thickness 0.01 whose nodes 2 and 3 follow curves 1 and 2 of displacement
/// along x; nodes 1 and 4 are held, and y and z of all.
std::string pulled_shell(const std::string& material, const std::string& control, Real at_2, Real at_3) {
  return fmt::format(
      "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n{}*SECTION_SHELL\n1,2\n0.01\n*PART\nplate\n1,1,1\n{}"
      "*NODE\n1,0.,0.,0.,7,7\n2,1.,0.,0.,5,7\n3,1.,1.,0.,5,7\n4,0.,1.,0.,7,7\n*ELEMENT_SHELL\n1,1,1,2,3,4\n"
      "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,2,1\n3,1,2,2\n*DEFINE_CURVE\n1\n0.,0.\n1.0,{}\n"
      "*DEFINE_CURVE\n2\n0.,0.\n1.0,{}\n*END\n",
      material, control, at_2, at_3);
}
const std::string elastic_steel = "*MAT_ELASTIC\n1,1000.,2.E8,0.3\n",
                  plastic_steel = "*MAT_PIECEWISE_LINEAR_PLASTICITY\n1,1000.,2.E8,0.3,1.E6\n\n\n\n";

Real thickness_after(const std::string& deck) {
  auto s = simulation_of(deck);
  while (s && s->clock().t < 1) s->step(do_nothing);
  return s ? thickness_of_shells(*s->world().groups.front())[0] : 0;
}

std::int64_t deleted(const std::string& deck) {
  auto s = simulation_of(deck);
  while (s && s->clock().t < 1) s->step(do_nothing);
  const auto found = s->world().counters.find("deleted_shells");
  return found == s->world().counters.end() ? 0 : found->second;
}

std::string body_cube(const std::string& rest) {
  return "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*MAT_RIGID\n2,2.0,200.0,0.3\n*SECTION_SOLID\n2,1\n*"
         "PART\ncube\n"
         "2,2,2\n*NODE\n11,0.,0.,0.\n12,1.,0.,0.\n13,1.,1.,0.\n14,0.,1.,0.\n15,0.,0.,1.\n16,1.,0.,1.\n"
         "17,1.,1.,1.\n18,0.,1.,1.\n*ELEMENT_SOLID\n1,2,11,12,13,14,15,16,17,18\n*DEFINE_CURVE\n1\n0.,1.\n1.,"
         "1.\n" +
         rest + "*END\n";
}
RigidBodyReport body_after(const std::string& deck, Real& energy_error) {
  auto s = simulation_of(deck);
  if (!s) return {};
  start_ledger(*s);
  while (s->clock().t < 1) s->step(do_nothing);
  energy_error = test::energy_error(*s);
  return s->world().passes.all<const RigidBodies>().front()->reports().front();
}

}  // namespace

// Along x by e with y held: all of the strain through the thickness is -nu/(1 - nu) e while it is elastic; at
// flow the elastic part of it is -nu/E (s_xx + s_yy), s_xx + s_yy = sqrt(3) SIGY.
TEST(CrashControls, ThicknessByFlowAlone) {
  const std::string all = "*CONTROL_SHELL\n20.,1,-1,1\n", flow = "*CONTROL_SHELL\n20.,1,-1,4\n",
                    thick = "*CONTROL_SHELL\n20.,1,-1,2\n";
  const Real e = std::log(1.02);
  EXPECT_NEAR(std::log(thickness_after(pulled_shell(elastic_steel, all, 0.02, 0.02)) / 0.01), -0.3 / 0.7 * e,
              1e-4);
  EXPECT_EQ(thickness_after(pulled_shell(elastic_steel, flow, 0.02, 0.02)), 0.01);
  EXPECT_EQ(thickness_after(pulled_shell(elastic_steel, thick, 0.02, 0.02)), 0.01) << "2 is of thick shells";
  const Real by_all = std::log(thickness_after(pulled_shell(plastic_steel, all, 0.02, 0.02)) / 0.01),
             by_flow = std::log(thickness_after(pulled_shell(plastic_steel, flow, 0.02, 0.02)) / 0.01);
  const Real of_elastic = -0.3 / 2e8 * std::sqrt(3.0) * 1e6;
  EXPECT_NEAR(by_all - by_flow, of_elastic, 0.03 * std::abs(of_elastic));
  EXPECT_NEAR(by_flow, -(e - 0.7 / 2e8 * std::sqrt(3.0) * 1e6), 0.02 * e) << "flow keeps the volume";
}

TEST(CrashControls, PartsWhoseThicknessFollows) {
  const std::string sets = "*SET_PART_LIST\n7\n1\n*SET_PART_LIST\n8\n2\n*PART\nother\n2,1,1\n";
  const auto after = [&](const char* card) {
    return thickness_after(
        pulled_shell(elastic_steel, sets + "*CONTROL_SHELL\n20.,1,-1,1\n\n" + card + "\n", 0.02, 0.02));
  };
  EXPECT_LT(after("7"), 0.01);
  EXPECT_EQ(after("8"), 0.01);
  EXPECT_EQ(after("-7"), 0.01);
  EXPECT_LT(after("-8"), 0.01);
}

// Node 3 goes over the diagonal 2-4 at -1: the corner turns inwards.
TEST(CrashControls, DistortedShellsAreDeleted) {
  const std::string stays = "*CONTROL_SHELL\n20.,1,-1,0\n", goes = stays + "\n\n1,1\n";
  EXPECT_EQ(deleted(pulled_shell(elastic_steel, stays, 0, -1.2)), 0);
  EXPECT_EQ(deleted(pulled_shell(elastic_steel, goes, 0, -1.2)), 1);
  EXPECT_EQ(deleted(pulled_shell(elastic_steel, goes, 0, -0.9)), 0);
}

// With 2 x 2 points the one beside node 3 has the area 0.622 a_3 + (a_2 + a_4)/6 + 0.045 a_1 of those at the
// corners, here (1, 1, 1 + u, 1 + u): it turns inwards at u = -1.27.
TEST(CrashControls, DistortedShellsStopTheRun) {
  const std::string stays = "*CONTROL_SHELL\n20.,1,-1,0\n", one_point = stays + "\n\n2,0\n",
                    four_points = stays + "\n\n0,1\n";
  EXPECT_THROW(deleted(pulled_shell(elastic_steel, one_point, 0, -1.2)), RunError);
  EXPECT_EQ(deleted(pulled_shell(elastic_steel, one_point, 0, -0.9)), 0);
  const auto full = [&](const std::string& control, Real at_3) {
    return std::regex_replace(pulled_shell(elastic_steel, control, 0, at_3), std::regex("\n1,2\n"),
                              "\n1,16\n");
  };
  EXPECT_EQ(deleted(full(stays, -1.2)), 0);
  EXPECT_THROW(deleted(full(stays, -1.35)), RunError);
  EXPECT_EQ(deleted(full(four_points, -1.35)), 1);
  EXPECT_EQ(deleted(full(four_points, -1.2)), 0);
}

// c = sqrt(E/(rho (1 - nu^2))): a shell of width 0.7 has the step 0.7/c, at the density of its mass over what
// is left of its volume 0.7/(sqrt(0.7) c) = 0.837/c.
TEST(CrashControls, ShellsWithASmallStepAreDeleted) {
  const Real c = std::sqrt(2e8 / (1000 * (1 - 0.09)));
  const auto deck = [&](Real tdel) {
    return pulled_shell(
        fmt::format("*MAT_PIECEWISE_LINEAR_PLASTICITY\n1,1000.,2.E8,0.3,1.E6,,,{}\n\n\n\n", tdel), "", -0.3,
        -0.3);
  };
  EXPECT_EQ(deleted(deck(0.9 * 0.87 / c)), 1);
  EXPECT_EQ(deleted(deck(0.9 * 0.80 / c)), 0);
  EXPECT_EQ(deleted(deck(0)), 0);
  try {
    deleted(deck(2 / c));
    FAIL() << "runs on without elements";
  } catch (const RunError& stop) {
    EXPECT_THAT(stop.what(), testing::StartsWith("all elements are deleted before the first step"));
  }
}

// A cube turns with 2 about z and goes with (3, 0, 0): its corner 11 has v = (3 + 1, -1, 0) at the start;
// along axes that turn with it v0 turns backwards, and omega x r stays.
TEST(CrashControls, AnAccelerometerTurnsWithItsBody) {
  const std::string turn =
      "*INITIAL_VELOCITY_GENERATION\n2,2,2.0,3.0,0.,0.\n0.5,0.5,0.5,0.,0.,1.\n"
      "*DATABASE_NODOUT\n0.1\n*DATABASE_HISTORY_NODE\n11,12\n"
      "*ELEMENT_SEATBELT_ACCELEROMETER\n1,11,12,14\n";
  auto s = simulation_of(body_cube(turn));
  Sample last;
  while (s->clock().t < 0.5)
    s->step([&](World&, const Clock&, const std::string& who) { last = s->sample(who); });
  const Real angle = 2 * (last.t - 0.5 * last.dt);  // velocities are those of the half step
  const Vec local(3 * std::cos(angle) + 1, -3 * std::sin(angle) - 1, 0);
  EXPECT_EQ(last.nodes[0].id, 11);
  EXPECT_NEAR((last.nodes[0].v - local).norm(), 0, 0.02) << last.nodes[0].v.transpose();
  EXPECT_NEAR((last.nodes[0].a - Vec(2, 2, 0)).norm(), 0, 0.02) << last.nodes[0].a.transpose();
  EXPECT_NEAR(last.nodes[0].omega[2], 2, 1e-9);
  const Vec global = Vec(3, 0, 0) + Vec(0, 0, 2).cross(last.nodes[1].x - s->world().nodes.x.vec(0)) * 0;
  EXPECT_GT((last.nodes[1].v - global).norm(), 0.5) << "12 is no accelerometer: its v turns with it";
}

// 4 at a corner along y: a = F/m at the centre, and about z r F/J, J = m/6.
TEST(CrashControls, AForceOnANodeOfABody) {
  Real error = 1;
  const RigidBodyReport body = body_after(body_cube("*LOAD_NODE_POINT\n12,2,1,0.004\n"), error);
  EXPECT_NEAR(body.v[1], 0.002, 1e-5);
  EXPECT_NEAR(body.omega[2], 0.5 * 0.004 / (2.0 / 6), 1e-4);
  EXPECT_LT(error, 0.01);
}

// Thrust along the normal of the face x = 1, through its corners, of a cube that turns with 3 about z: v =
// F/(m w) (sin w t, 1 - cos w t).
TEST(CrashControls, AFollowerForceTurnsWithItsNodes) {
  Real error = 1;
  const std::string turn =
      "*INITIAL_VELOCITY_GENERATION\n2,2,3.0,0.,0.,0.\n0.5,0.5,0.5,0.,0.,1.\n"
      "*SET_NODE_LIST\n1\n12,13,16,17\n*LOAD_NODE_SET\n1,4,1,0.25,0,12,13,16\n";
  const RigidBodyReport body = body_after(body_cube(turn), error);
  EXPECT_NEAR(body.v[0], 1 / (2 * 3.0) * std::sin(3.0), 3e-3);
  EXPECT_NEAR(body.v[1], 1 / (2 * 3.0) * (1 - std::cos(3.0)), 3e-3);
  EXPECT_NEAR(body.omega[2], 3, 1e-3);
  EXPECT_LT(error, 0.01);
}

// v = v0 exp(-D t), and the angular momentum about a principal axis alike; by part or for all.
TEST(CrashControls, DampingOfBodies) {
  const std::string flies = "*INITIAL_VELOCITY_GENERATION\n2,2,3.0,2.,0.,0.\n0.5,0.5,0.5,0.,0.,1.\n";
  for (const char* card : {"*DAMPING_GLOBAL\n0,0.7\n", "*DAMPING_PART_MASS\n2,1,0.7\n"}) {
    Real error = 1;
    const RigidBodyReport body = body_after(body_cube(flies + card), error);
    EXPECT_NEAR(body.v[0], 2 * std::exp(-0.7), 2e-3) << card;
    EXPECT_NEAR(body.omega[2], 3 * std::exp(-0.7), 3e-3) << card;
    EXPECT_LT(error, 1e-6) << card;
  }
  Real error = 1;
  const std::string along_y = "*DAMPING_PART_MASS\n2,1,0.7,1\n0.,1.,0.,0.,0.,0.\n";
  EXPECT_NEAR(body_after(body_cube(flies + along_y), error).v[0], 2, 1e-12);
}

// A block whose nodes are held along (1, 0, 1)/sqrt(2) slides down with g/2 along (1, 0, -1).
TEST(CrashControls, SupportsAlongObliqueAxes) {
  const std::string block =
      "*KEYWORD\n*CONTROL_TERMINATION\n0.1\n*MAT_ELASTIC\n2,1000.,1.E6,0.3\n*SECTION_SOLID\n2,1\n*"
      "PART\nblock\n"
      "2,2,2\n*NODE\n11,0.,0.,0.\n12,1.,0.,0.\n13,1.,1.,0.\n14,0.,1.,0.\n15,0.,0.,1.\n16,1.,0.,1.\n"
      "17,1.,1.,1.\n18,0.,1.,1.\n*ELEMENT_SOLID\n1,2,11,12,13,14,15,16,17,18\n*DEFINE_CURVE\n1\n0.,1.\n1.,1."
      "\n"
      "*LOAD_BODY_Z\n1,8.0\n*DEFINE_COORDINATE_SYSTEM\n5,0.,0.,0.,1.,0.,1.\n0.,1.,0.\n"
      "*SET_NODE_LIST_GENERATE\n1\n11,18\n*BOUNDARY_SPC_SET\n1,5,1,0,0\n*DATABASE_SPCFORC\n0.01\n*END\n";
  auto s = simulation_of(block);
  ASSERT_TRUE(s);
  Sample last;
  while (s->clock().t < 0.1)
    s->step([&](World&, const Clock&, const std::string& who) { last = s->sample(who); });
  const Real t = s->clock().t - 0.5 * s->clock().dt_old;
  for (Index n = 0; n < 8; ++n) {
    const Vec v = s->world().nodes.v.vec(n);
    EXPECT_NEAR((v - 4 * t * Vec(1, 0, -1)).norm(), 0, 1e-3 * 4 * t) << v.transpose();
    EXPECT_NEAR(v[0] + v[2], 0, 1e-15);
  }
  Vec support = Vec::Zero();
  for (const BoundaryForce& f : last.boundary_forces) support += f.force;
  EXPECT_NEAR((support - 1000 * 4 * Vec(1, 0, 1)).norm(), 0, 1) << support.transpose();
}

// The mean x of the face x = 1 goes from 1 with 3 past 2 at t = 1/3.
TEST(CrashControls, ASensorOfASetEndsTheRun) {
  const auto ends = [](const char* option) {
    auto s = simulation_of(body_cube(
        fmt::format("*INITIAL_VELOCITY_GENERATION\n2,2,0.,3.0,0.,0.\n\n*SET_NODE_LIST\n1\n11,12,13,14\n"
                    "*SENSOR_DEFINE_NODE_SET\n1,1,0,X,,COORD,{}\n*SENSOR_SWITCH\n2,SENSOR,1,GT,2.0\n*"
                    "TERMINATION_SENSOR\n2\n",
                    option)));
    if (!s) return Real(0);
    const auto endings = s->world().passes.all<const Ending>();
    while (s->clock().t < 1) {
      s->step(do_nothing);
      for (const Ending* ending : endings)
        if (ending->ended(s->world(), s->clock())) return s->clock().t;
    }
    return Real(1);
  };
  EXPECT_NEAR(ends("AVG"), 0.5, 0.01);
  EXPECT_NEAR(ends("MAX"), 1.0 / 3, 0.01);
  EXPECT_NEAR(ends("MIN"), 2.0 / 3, 0.01);
}
