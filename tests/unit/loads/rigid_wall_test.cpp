// Rigid walls against what a plastic impact, an incline and the balance of momentum tell.
#include <gtest/gtest.h>

#include <cmath>

#include "state/shared_fields.hpp"
#include "wall_scene.hpp"

using namespace courant;
using test::Pull;
using test::WallScene;

namespace {

const std::string floor_at_0 = "*RIGIDWALL_PLANAR\n0\n0.0,0.0,0.0,0.0,1.0,0.0,";

}  // namespace

TEST(RigidWall, StopsAMassAndTakesItsMomentum) {
  WallScene s;
  s.place({0.2, 0.0107, 0}, {0.5, -3, 1});
  s.walls(floor_at_0 + "0.0\n");
  s.start();
  s.steps(20);
  for (const Points& p : s.sets()) {
    EXPECT_NEAR(p.v->vec(0)[1], 0, 1e-15);
    EXPECT_NEAR(p.x->vec(0)[1], 0, 1e-15) << "it comes to rest on the wall";
    EXPECT_NEAR(p.v->vec(0)[0], 0.5, 1e-15) << "it slides";
    EXPECT_NEAR(p.v->vec(0)[2], 1, 1e-15);
  }
  const RigidWallForce wall = s.wall();
  EXPECT_NEAR((wall.impulse - Vec(0, -2 * 2 * 3, 0)).norm(), 0, 1e-13);
  EXPECT_NEAR(wall.dissipated, 2 * 0.5 * 2 * 9, 1e-13);
  EXPECT_NEAR(s.w.energy.dissipated, wall.dissipated, 1e-15);
  EXPECT_EQ(s.w.nodes.f.vec(1), Vec::Zero()) << "nodes of rigid bodies are left alone";
  EXPECT_NE(s.diagnostics.text().find("does not hold rigid bodies that can move: 1 of their nodes"),
            std::string::npos)
      << s.diagnostics.text();
}

TEST(RigidWall, LetsGoWhatIsPulledAway) {
  WallScene s;
  s.place({0, 0, 0}, {0, -1, 0});
  s.walls(floor_at_0 + "1.0\n");
  for (const Points& p : s.sets()) s.w.passes.add(std::make_shared<Pull>(p, Vec(0, 6, 0)));
  s.start();
  s.steps(200);
  // stopped in the first half step, then pulled with 3: dt_mean is half of the first dt there
  const Real t = s.cloud.clock.t - 0.5 * s.cloud.clock.dt_old - 0.5e-3;
  EXPECT_NEAR(s.w.nodes.v.vec(0)[1], 3 * t, 1e-2);
  EXPECT_GT(s.w.nodes.x.vec(0)[1], 0.1);
}

// On an incline of slope 0.5: mu < 0.5 slides with g (sin - mu cos), more sticks; energy goes to friction.
TEST(RigidWall, HoldsAndBrakesOnAnIncline) {
  for (const Real mu : {0.0, 0.3, 0.49, 0.51, 1.0}) {
    WallScene s;
    const Real angle = std::atan(0.5), g = 9.81;
    s.place({0, 0, 0}, {0, 0, 0});
    s.walls(floor_at_0 + std::to_string(mu) + "\n");
    s.gravity(g * Vec(std::sin(angle), -std::cos(angle), 0));
    s.start();
    s.steps(400);
    const Real a = g * std::max(std::sin(angle) - mu * std::cos(angle), 0.0), t = s.cloud.clock.t;
    for (const Points& p : s.sets()) {
      EXPECT_NEAR(p.x->vec(0)[0], 0.5 * a * t * t, 1e-9) << mu;
      EXPECT_NEAR(p.x->vec(0)[1], 0, 1e-14) << mu;
    }
    s.steps(1);  // the ledger is at the start of the step
    EXPECT_NEAR(s.kinetic + s.w.energy.potential + s.w.energy.dissipated - s.w.energy.external_work, 0, 0.1)
        << mu;
    EXPECT_NEAR(s.wall().normal, 4 * g * std::cos(angle), 1e-9);
    if (mu == 1) {
      EXPECT_NEAR(s.wall().force[0], 4 * g * std::sin(angle), 1e-9);
    } else if (a > 0) {
      EXPECT_NEAR(s.wall().force[0], mu * 4 * g * std::cos(angle), 1e-9);
    }
  }
}

TEST(RigidWall, AFiniteOneLetsPassWhatIsBesideIt) {
  WallScene s(5);
  const Real places[] = {0.5, -0.01, 2.01, 1.99};  // edge l from 0 to 2 along z, m = n x l along x
  for (Index i = 0; i < 4; ++i) s.w.nodes.x.set(i, {1, 0.1, places[i]}), s.w.nodes.v.set(i, {0, -1, 0});
  s.w.particles.x.set(0, {3.01, 0.1, 1}), s.w.particles.v.set(0, {0, -1, 0});
  s.walls("*RIGIDWALL_PLANAR_FINITE\n0\n0.,0.,0.,0.,5.,0.\n0.,3.,1.,2.,3.\n");
  s.start();
  s.steps(100);
  const Real way = s.cloud.clock.t;
  EXPECT_NEAR(s.w.nodes.x.vec(0)[1], 0, 1e-15);
  EXPECT_NEAR(s.w.nodes.x.vec(1)[1], 0.1 - way, 1e-13);
  EXPECT_NEAR(s.w.nodes.x.vec(2)[1], 0.1 - way, 1e-13);
  EXPECT_NEAR(s.w.nodes.x.vec(3)[1], 0, 1e-15);
  EXPECT_NEAR(s.w.particles.x.vec(0)[1], 0.1 - way, 1e-13);
  for (Index i = 1; i < 3; ++i)
    s.w.nodes.v.set(i, {0, 0, i == 1 ? 1.0 : -1.0});  // under it, as it is open there
  s.steps(100);
  EXPECT_NEAR(s.w.nodes.x.vec(1)[1], 0.1 - way, 1e-13);
  EXPECT_NEAR(s.wall().impulse[1], -4, 1e-13);
}

// A wall of mass 5 that moves with 0.5, and masses 2 that hit it one after the other. Each goes on with it
// until the next one drives the wall away from it: w = (5 w + 2 v)/7.
TEST(RigidWall, AMovingOneKeepsMomentum) {
  WallScene s(5);
  const Real speeds[] = {-3, -1, -0.2, 2};
  for (Index i = 0; i < 4; ++i)
    s.w.nodes.x.set(i, {0, 0.1 + 0.01 * i, 0}), s.w.nodes.v.set(i, {0, speeds[i], 0.7});
  s.w.particles.x.set(0, {0, 0.5, 0}), s.w.particles.v.set(0, {0, -2, 0});
  s.walls("*RIGIDWALL_PLANAR_MOVING_FORCES\n0\n0.,0.,0.,0.,1.,0.\n5.0,0.5\n0\n");
  s.start();
  Real before = 5 * 0.5, energy = 0.5 * 5 * 0.25;
  for (Index i = 0; i < 4; ++i) before += 2 * speeds[i], energy += speeds[i] * speeds[i] + 0.49;
  before += 2 * -2.0, energy += 4;
  for (int k = 0; k < 300; ++k) {
    s.steps(1);
    ASSERT_NEAR(s.momentum[1] + 5 * s.wall().v[1], before, 1e-13) << k;
  }
  s.steps(1);
  EXPECT_NEAR(s.kinetic + s.w.energy.kinetic + s.w.energy.dissipated, energy, 1e-12);
  const Real first = (5 * 0.5 + 2 * -3) / 7, second = (5 * first + 2 * -1) / 7,
             third = (5 * second + 2 * -2) / 7;
  EXPECT_NEAR(s.w.nodes.v.vec(0)[1], first, 1e-14);
  EXPECT_NEAR(s.w.nodes.v.vec(1)[1], second, 1e-14);
  EXPECT_NEAR(s.w.nodes.v.vec(2)[1], -0.2, 1e-15) << "too slow to come to it";
  EXPECT_NEAR(s.w.nodes.v.vec(3)[1], 2, 1e-15) << "it flew away before";
  EXPECT_NEAR(s.w.particles.v.vec(0)[1], third, 1e-14);
  EXPECT_NEAR(s.wall().v[1], third, 1e-14);
  EXPECT_NEAR(s.w.nodes.v.vec(0)[2], 0.7, 1e-15);
  EXPECT_NEAR(s.w.particles.x.vec(0)[1], s.wall().displacement[1], 1e-13);
}

TEST(RigidWall, AMovingOneGoesOnAsOneBodyWithAllThatItHolds) {
  WallScene s(5);
  const Real speeds[] = {-3, -1, -2, 0.1};  // all of them at the wall
  for (Index i = 0; i < 4; ++i) s.w.nodes.x.set(i, {0, 0, 0}), s.w.nodes.v.set(i, {0, speeds[i], 0});
  s.w.particles.x.set(0, {0, 0, 0}), s.w.particles.v.set(0, {0, -3, 0});
  s.walls("*RIGIDWALL_PLANAR_MOVING\n0\n0.,0.,0.,0.,1.,0.\n5.0,0.5\n");
  s.start();
  s.steps(1);
  const Real common = (5 * 0.5 + 2 * (-3 - 2 - 3)) / 11;  // -1.227: two leave it, -1 and 0.1
  EXPECT_NEAR(s.wall().v[1], common, 1e-14);
  EXPECT_NEAR(s.w.nodes.v.vec(0)[1], common, 1e-14);
  EXPECT_NEAR(s.w.nodes.v.vec(1)[1], -1, 1e-15);
  EXPECT_NEAR(s.w.nodes.v.vec(2)[1], common, 1e-14);
  EXPECT_NEAR(s.w.nodes.v.vec(3)[1], 0.1, 1e-15);
  EXPECT_NEAR(s.w.particles.v.vec(0)[1], common, 1e-14);
}

TEST(RigidWall, WeldsWhatHitsHardEnough) {
  for (const Real weld_speed : {0.5, 1.5})
    for (const int fric : {2, 3}) {
      WallScene s;
      s.place({0, 0.01, 0}, {1, -1, 0});
      s.walls(floor_at_0 + std::to_string(fric) + "," + std::to_string(weld_speed) + "\n");
      for (const Points& p : s.sets()) s.w.passes.add(std::make_shared<Pull>(p, Vec(0, 6, 0)));
      s.start();
      s.steps(300);
      const Vec x = s.w.nodes.x.vec(0);
      if (weld_speed > 1) {
        EXPECT_GT(x[1], 0.1);
      } else {
        EXPECT_NEAR(x[1], 0, 1e-14);
        EXPECT_NEAR(s.w.nodes.v.vec(0)[0], fric == 2 ? 1 : 0, 1e-13);
        EXPECT_NEAR(s.wall().normal, -12, 1e-9) << "it holds the points back";
      }
    }
}

TEST(RigidWall, HoldsFromBirthToDeath) {
  WallScene s;
  s.place({0, 0, 0}, {0, 0, 0});
  s.walls("*RIGIDWALL_PLANAR\n0,0,0,0.,0.1,0.2\n0.,0.,0.,0.,1.,0.\n");
  for (const Points& p : s.sets()) s.w.passes.add(std::make_shared<Pull>(p, Vec(0, -2, 0)));
  s.start();
  while (s.cloud.clock.t < 0.1) s.steps(1);
  EXPECT_LT(s.w.nodes.v.vec(0)[1], -0.09);
  s.steps(1);
  EXPECT_NEAR(s.w.nodes.v.vec(0)[1], 0, 1e-15) << "what is behind it goes no deeper";
  const Real depth = s.w.nodes.x.vec(0)[1];
  while (s.cloud.clock.t < 0.19) s.steps(1);
  EXPECT_NEAR(s.w.nodes.x.vec(0)[1], depth, 1e-15);
  while (s.cloud.clock.t < 0.4) s.steps(1);
  EXPECT_LT(s.w.nodes.v.vec(0)[1], -0.15);
}

TEST(RigidWall, HoldsTheNodesThatItsCardNames) {
  const auto held = [](const std::string& card) {
    WallScene s(4);
    for (Index i = 0; i < 3; ++i) {
      const Vec x(static_cast<Real>(i), 0.1 * static_cast<Real>(1 + i), 0);
      s.w.nodes.x.set(i, x), s.model.nodes[1 + static_cast<std::size_t>(i)].x = x;
    }
    s.w.particles.x.set(0, {5, 0.1, 0}), s.model.nodes[0].x = {5, 0.1, 0};
    s.w.nodes.held[3] = 1;
    s.model.node_sets[7] = {0, 1, 2}, s.model.node_sets[8] = {2};
    s.model.boxes[3] = {.id = 3, .low = Vec(-1, -1, -1), .high = Vec(1.5, 1, 1)};
    s.walls("*RIGIDWALL_PLANAR\n" + card + "\n0.,0.,0.,0.,1.,0.\n");
    EXPECT_EQ(s.diagnostics.text(), "");
    for (const Points& p : s.sets())
      for (Index i = 0; i < p.set->size(); ++i) p.v->set(i, {0, -10, 0});
    s.start();
    s.steps(100);
    std::string out;
    for (const Points& p : s.sets())
      for (Index i = 0; i < p.set->size(); ++i)
        if (std::abs(p.x->vec(i)[1]) < 1e-12 && (*p.id)[i] != 14) out += std::to_string((*p.id)[i]) + " ";
    return out;
  };
  EXPECT_EQ(held("0"), "1 11 12 13 ");
  EXPECT_EQ(held("7"), "1 11 12 ");
  EXPECT_EQ(held("7,8"), "1 11 ");
  EXPECT_EQ(held("0,7"), "13 ");
  EXPECT_EQ(held("0,0,3"), "11 12 ");
  EXPECT_EQ(held("7,0,3"), "11 12 ");
  EXPECT_EQ(held("0,0,0,0.15"), "1 11 ");
}

TEST(RigidWall, SeveralHoldACornerOfAnyAngle) {
  for (const Real degrees : {30.0, 90.0, 150.0}) {  // of the sub-domain between two walls, below y = 0
    WallScene s;
    s.place({0, 0.01, 0}, {0, 0, 0});
    const Real a = 0.5 * degrees * pi / 180;
    const Vec left(std::cos(a), std::sin(a), 0), right(-std::cos(a), std::sin(a), 0);
    std::string cards;
    for (const Vec& n : {left, right})
      cards +=
          "*RIGIDWALL_PLANAR\n0\n0.,0.,0.," + std::to_string(n[0]) + "," + std::to_string(n[1]) + ",0.\n";
    s.walls(cards);
    s.gravity({0.3, -9.81, 0});
    s.start();
    s.steps(500);
    for (const Points& p : s.sets()) {
      EXPECT_GT(p.x->vec(0).dot(left), -1e-5) << degrees;
      EXPECT_GT(p.x->vec(0).dot(right), -1e-5) << degrees;
      EXPECT_LT(p.v->vec(0).norm(), 1e-6) << degrees;
    }
    EXPECT_NEAR(((s.wall(0).force + s.wall(1).force) - 4 * Vec(0.3, -9.81, 0)).norm(), 0, 1e-6) << degrees;
  }
}

TEST(RigidWall, PushesAlongTheAxesThatSupportsLeaveFree) {
  WallScene s;
  s.place({0, 0.02, 0}, {0, -1, 0});
  s.model.nodes[0].fixed = s.model.nodes[1].fixed = {true, false, false};
  for (const Points& p : s.sets()) s.w.passes.add(make_fixed_points(s.model, p, s.w));
  s.walls("*RIGIDWALL_PLANAR\n0\n0.,0.,0.,1.,1.,0.\n");
  s.start();
  s.steps(100);
  for (const Points& p : s.sets()) {
    EXPECT_NEAR(p.x->vec(0).norm(), 0, 1e-14);
    EXPECT_EQ(p.x->vec(0)[0], 0);
  }
  EXPECT_NEAR(s.wall().dissipated, 2, 1e-13);
  // without friction it pushes along its normal, whatever the supports take of that
  EXPECT_NEAR((s.wall().impulse - Vec(-4, -4, 0)).norm(), 0, 1e-13);
}

TEST(RigidWall, HasTheSameBitsOnAnyNumberOfThreads) {
  const auto run = [](int threads) {
    set_threads(threads);
    WallScene s(500);
    for (Index i = 0; i < 499; ++i) {
      s.w.nodes.x.set(i, {0.01 * i, 0.01 + 0.001 * (i % 17), 0});
      s.w.nodes.v.set(i, {0.1, -1 - 0.1 * (i % 13), 0.3});
    }
    s.walls("*RIGIDWALL_PLANAR_MOVING\n0\n0.,0.,0.,0.,1.,0.,0.2\n100.0,0.5\n");
    s.start();
    s.steps(50);
    set_threads(1);
    return std::pair(s.wall().impulse, s.w.nodes.x.vec(77));
  };
  const auto one = run(1);
  for (const int threads : {2, 4}) EXPECT_EQ(run(threads), one) << threads;
}

TEST(RigidWall, HasItsIdOrItsNumberOrTheNextFreeOne) {
  WallScene s;
  s.walls("*RIGIDWALL_PLANAR_ID\n         2anvil\n0\n0.,0.,0.,0.,1.,0.\n" + floor_at_0 + "0.0\n" +
          floor_at_0 + "0.0\n");
  EXPECT_EQ(s.wall(0).id, 2);
  EXPECT_EQ(s.wall(0).title, "anvil");
  EXPECT_EQ(s.wall(1).id, 3) << "2 is taken";
  EXPECT_EQ(s.wall(2).id, 4);
}

TEST(RigidWall, IsRefusedByName) {
  const auto faults = [](const std::string& cards) {
    WallScene s;
    s.w.dim = 2;
    s.walls(cards);
    return s.diagnostics.text();
  };
  EXPECT_NE(
      faults("*RIGIDWALL_PLANAR\n0\n0.,1.,0.,0.,1.,0.\n").find("tail and head of the normal are the same"),
      std::string::npos);
  EXPECT_NE(faults("*RIGIDWALL_PLANAR\n0\n0.,1.,0.,0.,1.,1.\n").find("in 2D nothing moves along z"),
            std::string::npos);
  EXPECT_NE(faults("*RIGIDWALL_PLANAR\n5\n0.,1.,0.,0.,2.,0.\n").find("node set 5 does not exist"),
            std::string::npos);
  EXPECT_NE(faults("*RIGIDWALL_PLANAR\n0,0,5\n0.,1.,0.,0.,2.,0.\n").find("box 5 does not exist"),
            std::string::npos);
  EXPECT_NE(faults("*RIGIDWALL_PLANAR\n0\n0.,1.,0.,0.,2.,0.,1.5\n").find("expected a number from 0 to 1"),
            std::string::npos);
  EXPECT_NE(faults("*RIGIDWALL_PLANAR_FINITE\n0\n0.,1.,0.,0.,2.,0.\n0.,3.,0.\n").find("no direction"),
            std::string::npos);
}
