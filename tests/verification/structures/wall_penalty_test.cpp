// Rigid walls and rigid bodies: RWPNAL of *CONTROL_CONTACT, by the laws of impact, friction and momentum.
#include <gtest/gtest.h>

#include <cmath>

#include "same_bits.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;
using test::simulation_of;
using test::start_ledger;

namespace {

/// A rigid cube of mass 2 and side 1 with its lower face at z = 0.5, x, y in 0 to 1; steps of 4e-4.
std::string flying_cube(const std::string& velocity, const std::string& rest, Real rwpnal = 1) {
  return fmt::format(
      "*KEYWORD\n*CONTROL_TERMINATION\n0.4\n*CONTROL_CONTACT\n0.0,{}\n*MAT_RIGID\n2,2.0,200.0,0.3\n"
      "*SECTION_SOLID\n2,1\n*PART\ncube\n2,2,2\n*NODE\n11,0.,0.,0.5\n12,1.,0.,0.5\n13,1.,1.,0.5\n14,0.,1.,0."
      "5\n"
      "15,0.,0.,1.5\n16,1.,0.,1.5\n17,1.,1.,1.5\n18,0.,1.,1.5\n*ELEMENT_SOLID\n1,2,11,12,13,14,15,16,17,18\n"
      "*INITIAL_VELOCITY\n\n{}\n{}*END\n",
      rwpnal, velocity, rest);
}
const std::string floor_plane = "*RIGIDWALL_PLANAR\n0\n0.0,0.0,0.0,0.0,0.0,1.0,";

struct CubeEnd {
  Vec v = Vec::Zero(), omega = Vec::Zero(), x = Vec::Zero();
  Real energy_error = 0;
  RigidWallForce wall;
};
CubeEnd end_of(const std::string& deck, Real until = 0.4) {
  auto s = simulation_of(deck);
  if (!s) return {};
  start_ledger(*s);
  while (s->clock().t < until) s->step([](World&, const Clock&, const std::string&) {});
  CubeEnd out;
  for (const auto* bodies : s->world().passes.all<const RigidBodies>()) {
    const RigidBodyReport body = bodies->reports().front();
    out.v = body.v, out.omega = body.omega, out.x = body.x;
  }
  out.energy_error = test::energy_error(*s);
  for (const auto* wall : s->world().passes.all<const RigidWallReporter>()) out.wall = wall->report_wall();
  return out;
}

}  // namespace

TEST(WallPenalty, ACubeBouncesOffAPlane) {
  const CubeEnd end = end_of(flying_cube("0.5,0.0,-4.0", floor_plane + "0.0\n"));
  EXPECT_NEAR(end.v[2], 4, 0.04) << "the kink of the force at touch costs leapfrog its second order";
  EXPECT_NEAR(end.v[0], 0.5, 1e-12);
  EXPECT_NEAR(end.omega.norm(), 0, 1e-9);
  EXPECT_NEAR((end.wall.impulse + 2 * (end.v - Vec(0.5, 0, -4))).norm(), 0, 1e-11) << "all momentum, no more";
  EXPECT_LT(end.energy_error, 0.01);
  EXPECT_EQ(end.wall.dissipated, 0);
}

TEST(WallPenalty, WithoutItBodiesGoThrough) {
  const CubeEnd end = end_of(flying_cube("0.0,0.0,-4.0", floor_plane + "0.0\n", 0));
  EXPECT_EQ(end.v[2], -4);
  EXPECT_EQ(end.wall.impulse, Vec::Zero());
}

TEST(WallPenalty, ScaleOfAWallSoftensIt) {
  // RWKSF 0.01: ten times as deep and slow, m w^2 = 1/100 of that before
  const std::string soft = "*RIGIDWALL_PLANAR\n0,,,,,,0.01\n0.0,0.0,0.0,0.0,0.0,1.0,0.0\n";
  auto hard = simulation_of(flying_cube("0.0,0.0,-4.0", floor_plane + "0.0\n"));
  auto slow = simulation_of(flying_cube("0.0,0.0,-4.0", soft));
  Real least[2]{1, 1};
  int k = 0;
  for (auto* s : {hard.get(), slow.get()}) {
    while (s->clock().t < 0.3) {
      s->step([](World&, const Clock&, const std::string&) {});
      least[k] = std::min(least[k], s->world().nodes.x.vec(0)[2]);
    }
    ++k;
  }
  EXPECT_NEAR(least[1] / least[0], 10, 0.3);
}

// Each shape from the side from which the cube comes; it bounces along the normal where that is its own axis.
TEST(WallPenalty, AllShapesHoldBodies) {
  const struct {
    const char* wall;
    Real least;  // of the speed at which the cube comes back
  } shapes[] = {
      {"*RIGIDWALL_GEOMETRIC_FLAT\n0\n-1.,-1.,0.,-1.,-1.,1.,0.0\n5.,-1.,0.,4.,4.\n", 3.95},
      {"*RIGIDWALL_GEOMETRIC_PRISM\n0\n-1.,-1.,0.,-1.,-1.,1.,0.0\n5.,-1.,0.,4.,4.,2.\n", 3.95},
      {"*RIGIDWALL_GEOMETRIC_CYLINDER\n0\n0.5,-9.,-3000.,0.5,9.,-3000.,0.0\n3000.0\n", 3.95},
      {"*RIGIDWALL_GEOMETRIC_SPHERE\n0\n0.5,0.5,-3000.,0.5,0.5,0.,0.0\n3000.0\n", 3.95},
  };
  for (const auto& shape : shapes) {
    const CubeEnd end = end_of(flying_cube("0.0,0.0,-4.0", shape.wall));
    EXPECT_GT(end.v[2], shape.least) << shape.wall;
    EXPECT_LT(end.energy_error, 0.01) << shape.wall;
  }
}

TEST(WallPenalty, ABodyPassesBesideAnEdge) {
  const CubeEnd beside = end_of(flying_cube("0.0,0.0,-4.0",
                                            "*RIGIDWALL_GEOMETRIC_FLAT\n0\n2.,-1.,0.,2.,-1.,1.,0.0\n"
                                            "9.,-1.,0.,4.,4.\n"));
  EXPECT_EQ(beside.v[2], -4);
}

// Gravity 10 presses it on; friction 0.3 stops 0.6 after 0.2 and 0.06.
TEST(WallPenalty, FrictionStopsWhatSlides) {
  const std::string gravity = "*LOAD_BODY_Z\n1,10.0\n*DEFINE_CURVE\n1\n0.0,1.0\n1.0,1.0\n";
  const std::string on_it = "*RIGIDWALL_PLANAR\n0\n0.0,0.0,0.4999999,0.0,0.0,1.0,0.3\n";
  const CubeEnd end = end_of(flying_cube("0.6,0.0,0.0", gravity + on_it));
  EXPECT_NEAR(end.v[0], 0, 5e-4) << "it rocks on its springs";
  EXPECT_NEAR(end.x[0] - 0.5, 0.06, 0.002);
  EXPECT_NEAR(end.wall.dissipated, 0.5 * 2 * 0.36, 0.01);
  EXPECT_NEAR(end.wall.impulse[0], 2 * 0.6, 1e-3);
  EXPECT_LT(end.energy_error, 0.01);
}

// Masses 2 and 3 at -4 and 1 along z: the difference turns round, the momentum stays.
TEST(WallPenalty, AWallWithAMassTakesTheMomentum) {
  const std::string moving = "*RIGIDWALL_PLANAR_MOVING\n0\n0.0,0.0,0.0,0.0,0.0,1.0,0.0\n3.0,1.0\n";
  const CubeEnd end = end_of(flying_cube("0.0,0.0,-4.0", moving));
  EXPECT_NEAR(2 * end.v[2] + 3 * end.wall.v[2], 2 * -4 + 3 * 1, 1e-11);
  EXPECT_NEAR(end.v[2] - end.wall.v[2], 5, 0.05);
  EXPECT_LT(end.energy_error, 0.01);
}

// A wall that comes with 4: the cube, at rest, leaves with 8.
TEST(WallPenalty, ADrivenWallPushes) {
  const std::string driven =
      "*RIGIDWALL_GEOMETRIC_FLAT_MOTION\n0\n0.,0.,0.,0.,0.,1.,0.0\n5.,0.,0.,0.,0.\n"
      "1,0,0.,0.,1.\n*DEFINE_CURVE\n1\n0.0,4.0\n1.0,4.0\n";
  const CubeEnd end = end_of(flying_cube("0.0,0.0,0.0", driven));
  EXPECT_NEAR(end.v[2], 8, 0.08);
  EXPECT_LT(end.energy_error, 0.01);
}

// Obliquely, so that it turns: what the ledger has is all there is.
TEST(WallPenalty, ACornerFirst) {
  const std::string oblique = "*RIGIDWALL_PLANAR\n0\n0.0,0.0,0.0,-0.2,-0.1,1.0,0.4\n";
  const CubeEnd end = end_of(flying_cube("0.5,0.0,-4.0", oblique));
  EXPECT_GT(end.omega.norm(), 0.5);
  EXPECT_GT(end.v[2], -2);
  EXPECT_LT(end.energy_error, 0.02);
}

TEST(WallPenalty, TheSameOnAnyThreadsAndAfterARestart) {
  test::expect_same_bits(flying_cube("0.5,0.0,-4.0", floor_plane + "0.3\n"), 500, 317);
}
