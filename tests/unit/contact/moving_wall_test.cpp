// Contact and a free rigid plate together.
#include <gtest/gtest.h>

#include "rigid/bodies/rigid.hpp"
#include "scene.hpp"

using namespace courant;
using courant::test::Scene;

namespace {

/// One body of all nodes of the scene.
RigidBodies body_of(World& world) {
  RigidBody b;
  b.part = 1;
  for (Index n = 0; n < world.nodes.size(); ++n) {
    b.nodes.push_back(n);
    b.m += world.nodes.m[n];
    b.x += world.nodes.m[n] * world.nodes.x.vec(n);
  }
  b.x /= b.m;
  for (Index n = 0; n < world.nodes.size(); ++n) {
    const Vec X = world.nodes.x.vec(n) - b.x;
    b.X.push_back(X);
    b.J0 += world.nodes.m[n] * (X.squaredNorm() * Matrix::Identity() - X * X.transpose());
  }
  return RigidBodies({b});
}

void collide(Real friction) {
  Scene s;
  s.held = false;
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 3, 3);
  s.x = {Vec(0.02, 0.02, 0.03), Vec(0.08, 0.05, 0.02), Vec(0.05, 0.104, 0.015), Vec(0.03, 0.06, -0.02)};
  s.v = {Vec(0.1, 0, -0.5), Vec(0, 0.1, -0.3), Vec(0, 0, -0.3), Vec(0, 0, 0.4)};
  s.law.fs = s.law.fd = friction;
  s.law.vdc = 5;
  s.build();
  for (Index n = 0; n < s.world.nodes.size(); ++n) s.world.nodes.m[n] = 1e-4;
  RigidBodies bodies = body_of(s.world);
  const auto momentum = [&](Vec& P, Vec& L) {
    const RigidBody& b = bodies.bodies()[0];
    P = b.m * b.v;
    L = b.L + b.m * b.x.cross(b.v);
    for (Index i = 0; i < 4; ++i) {
      P += s.m * s.world.particles.v.vec(i);
      L += s.m * s.world.particles.x.vec(i).cross(s.world.particles.v.vec(i));
    }
  };
  Vec P0, L0, P1, L1;
  momentum(P0, L0);
  s.before_move = [&] {
    bodies.apply(s.world, s.clock);
    bodies.kick(s.world, s.clock);
    bodies.drift(s.world, s.clock);
  };
  while (s.clock.t < 0.2) s.step(2e-5);
  momentum(P1, L1);
  EXPECT_GT(bodies.bodies()[0].v.norm(), 0.01);
  EXPECT_GT(bodies.bodies()[0].omega.norm(), 0.1);
  EXPECT_NEAR((P1 - P0).norm(), 0, 1e-15);
  EXPECT_EQ(s.world.counters.at("leaked_particles"), 0);
  // friction acts at the wall, up to r away from the particle, and this couple is not balanced
  if (friction == 0) {
    EXPECT_NEAR((L1 - L0).norm(), 0, 1e-15);
  }
}

TEST(MovingWall, MomentumOfParticlesAndFreePlateIsKept) {
  collide(0);
  collide(0.3);
}

// A plate that turns quickly sweeps through a particle at rest: its path, seen from the plate, goes through
// the mid-surface, and it is pulled back to the side it was on.
TEST(MovingWall, FastPlateDoesNotPassAParticle) {
  Scene s;
  s.held = false;
  s.thickness = 0.002;
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 2, 2);
  s.x = {Vec(0.05, 0.05, 0.003)};
  s.build();
  for (int k = 0; k < 10; ++k) {  // 1 mm per step
    for (Index n = 0; n < s.world.nodes.size(); ++n) {
      s.world.nodes.v.set(n, Vec(0, 0, 1));
      s.world.nodes.x.add(n, k > 0 ? Vec(0, 0, 1e-3) : Vec(0, 0, 0));
    }
    s.refresh();
    s.clear();
    s.clock.dt_old = k > 0 ? 1e-3 : 0;
    courant::test::run(*s.contact, s.world, s.clock);
    s.world.particles.v.set(0, Vec::Zero());
  }
  EXPECT_EQ(s.world.counters.at("leaked_particles"), 1);
  EXPECT_GT(s.world.particles.f.vec(0).z(), 0);
}

/// Whether a plate over 0 < x < 0.1 that moves by 0.04 along x while it rises from z = 0 to 0.004, all in one
/// step, is seen to pass a particle at rest at z = 0.002.
bool is_passed(Real x) {
  Scene s;
  s.held = false;
  s.thickness = 0.002;
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0));
  s.x = {Vec(x, 0.05, 0.002)};
  s.build();
  for (Index n = 0; n < s.world.nodes.size(); ++n) {
    s.world.nodes.v.set(n, Vec(40, 0, 4));
    s.world.nodes.x.add(n, Vec(0.04, 0, 0.004));
  }
  s.clock.dt_old = 1e-3;
  s.refresh();
  s.clear();
  courant::test::run(*s.contact, s.world, s.clock);
  const bool pulled = s.world.particles.f.vec(0).z() > 0;
  EXPECT_EQ(s.world.counters.at("leaked_particles"), pulled ? 1 : 0) << x;
  return pulled;
}

// They meet in the middle of the step, when the plate is over 0.02 < x < 0.12: neither where it was nor where
// it is now.
TEST(MovingWall, APathIsSeenFromThePlateOverTheWholeStep) {
  EXPECT_FALSE(is_passed(0.015));
  EXPECT_TRUE(is_passed(0.025));
  EXPECT_TRUE(is_passed(0.07));
  EXPECT_TRUE(is_passed(0.115));
  EXPECT_FALSE(is_passed(0.125));
}

}  // namespace
