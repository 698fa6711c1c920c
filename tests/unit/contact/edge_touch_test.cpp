// Two edges that touch, by hand: shares, stiffness, damping, friction, energies, what is reported.
#include <gtest/gtest.h>

#include <cmath>

#include "edge_scene.hpp"
#include "state/shared_fields.hpp"

using namespace courant;

namespace edge_touch_test {
namespace {

using test::edges::EdgeScene;
using test::edges::k;
using test::edges::r;

}  // namespace

// 0.1 of the softer edge times the depth, by shares of the position where they touch; SURFA gets what its
// edge gets, whichever comes first.
TEST(EdgeTouch, ForcesAreInBalanceAndOfTheSofterEdge) {
  for (const bool turned : {false, true}) {
    EdgeScene s;
    if (turned) s.sides = {2, 1};
    s.build();
    s.come(Vec::Zero());
    const Real F = k * 0.004, share[4] = {0.7, 0.3, -0.4, -0.6};
    Vec sum = Vec::Zero(), moment = Vec::Zero();
    for (Index n = 0; n < 4; ++n) {
      EXPECT_NEAR((s.force_on(n) - Vec(0, 0, share[n] * F)).norm(), 0, 1e-14) << n;
      sum += s.force_on(n), moment += s.world.nodes.x.vec(n).cross(s.force_on(n));
    }
    EXPECT_NEAR(sum.norm() + moment.norm(), 0, 1e-14);
    EXPECT_NEAR(s.contact->report().on_surfa[2], turned ? -F : F, 1e-14);
    EXPECT_NEAR(s.contact->report().energy_stored, 0.5 * k * 0.004 * 0.004, 1e-16);
    EXPECT_NEAR(s.sampled().contact, 0.5 * k * 0.004 * 0.004, 1e-16);
  }
}

// SOFT 1: at least SOFSCL m/(2 dt^2), m the lightest node, dt DTSTIF, or the longest step so far, of 0.005.
TEST(EdgeTouch, SoftOneTakesTheStifferOfEdgeAndMass) {
  for (const Real dtstif : {0.0, 0.01, 10.0}) {
    EdgeScene s;
    s.law.soft = 1, s.law.sofscl = 0.2, s.law.dtstif = dtstif;
    s.build();
    s.come(Vec::Zero());
    const Real dt = dtstif > 0 ? dtstif : 0.005, soft = 0.2 * 0.5 * 1 / (dt * dt);
    EXPECT_NEAR(s.sampled().contact, 0.5 * std::max(soft, k) * 0.004 * 0.004, 1e-12) << dtstif;
  }
}

// What is nearer than both radii from the start gives no force, but what comes on top of that.
TEST(EdgeTouch, DepthOfTheStartGivesNoForce) {
  EdgeScene s;
  s.gap = -0.003, s.v = Vec::Zero();
  s.build();
  s.step(0), s.step(1e-4);
  EXPECT_EQ(s.on_a(), Vec::Zero());
  for (Index n : {0, 1}) s.world.nodes.v.set(n, Vec(0, 0, -0.1));
  s.step(0.01);
  EXPECT_NEAR(s.on_a()[2], k * 0.001, 1e-14);
  EXPECT_NEAR(s.sampled().contact, 0.5 * k * 1e-6, 1e-16);
}

TEST(EdgeTouch, DampingIsNeverTension) {
  EdgeScene s;
  s.law.vdc = 100;
  s.build();
  s.come(Vec(0, 0, 1));
  EXPECT_EQ(s.on_a()[2], 0);
}

// Damping and friction with forces on the nodes: their work is that of the mean velocities of the step to
// come, in the ledger and in what the contact reports; what springs of friction hold is not lost yet.
TEST(EdgeTouch, WorkIsOfTheMeanVelocitiesOfBothEdges) {
  for (const bool driven : {false, true})
    for (const Real vdc : {0.0, 10.0}) {
      EdgeScene s;
      s.law.fs = s.law.fd = 0.5, s.law.vdc = vdc;
      s.build();
      if (driven) shared_fields::prescribed_motion.add(s.world.nodes.fields)[0] = 1;
      s.come(Vec(0.1, 0.05, -0.01));
      for (int n = 0; n < 8; ++n) s.step(0.02);
      Nodes& nodes = s.world.nodes;
      const Vec f[4] = {Vec(1, -1, 2), Vec(-2, 0, 1), Vec(3, 1, 0), Vec(0, 2, -1)};
      nodes.v.set(3, Vec(-0.03, 0, 0.02));
      s.step(1e-9);
      for (Index n = 0; n < 4; ++n) nodes.f.set(n, f[n]);
      s.clock.dt = 0.01, s.clock.dt_old = 0.02;
      const Real dt = s.clock.dt_mean();
      // shares of where they touch now
      const Real at = (nodes.x.vec(2)[0] - nodes.x.vec(0)[0]), on = -nodes.x.vec(2)[1] + nodes.x.vec(0)[1];
      const Vec xb = nodes.x.vec(3) - nodes.x.vec(2);
      const Real t = on / xb[1];
      const Real share[4] = {1 - (at + t * xb[0]), at + t * xb[0], -(1 - t), -t};
      Vec v = Vec::Zero();
      for (Index n = 0; n < 4; ++n)
        v += share[n] * (nodes.v.vec(n) + (driven && n == 0 ? 0 : 0.5 * dt / nodes.m[n]) * f[n]);
      const Vec force = s.on_a();
      const Vec normal = Vec::UnitZ();
      const Real depth = std::sqrt(2 * s.sampled().contact / k), damping = force.dot(normal) - k * depth;
      if (vdc > 0) EXPECT_GT(std::abs(damping), 1e-4);
      const Vec friction = force - force.dot(normal) * normal;
      if (vdc == 0) EXPECT_NEAR(friction.norm(), 0.5 * force.dot(normal), 1e-9) << "it slides";
      const InterfaceForce before = s.contact->report();
      const EnergyLedger lost = s.recorded();
      const InterfaceForce after = s.contact->report();
      const Real of_friction = -friction.dot(v) * dt, of_damping = -damping * normal.dot(v) * dt;
      // the edges are a little askew by now, 1e-3 of the normal
      EXPECT_NEAR(after.energy_friction - before.energy_friction, of_friction, 3e-3 * std::abs(of_friction));
      EXPECT_NEAR(after.energy_damping - before.energy_damping, of_damping,
                  3e-3 * (std::abs(of_friction) + std::abs(of_damping)));
      EXPECT_NEAR(
          lost.dissipated,
          after.energy_friction - before.energy_friction + after.energy_damping - before.energy_damping,
          1e-15);
      EXPECT_NEAR(lost.throughput, std::abs(lost.dissipated), 1e-15);
    }
}

// Side by side two touches have half of the length that both share each: together the stiffness of that part,
// and a stress VC on the smaller area times the part.
TEST(EdgeTouch, SideBySideTheyTouchAlongWhatTheyShare) {
  EdgeScene s;
  s.parallel = true, s.held = true;
  s.build();
  s.come(Vec::Zero());
  EXPECT_NEAR(s.on_a()[2], 0.8 * k * 0.004, 1e-12);
  EXPECT_NEAR(s.sampled().contact, 0.8 * 0.5 * k * 0.004 * 0.004, 1e-14);
  Vec moment = Vec::Zero();
  for (Index n = 0; n < 4; ++n) moment += s.world.nodes.x.vec(n).cross(s.force_on(n));
  EXPECT_NEAR(moment.norm(), 0, 1e-14);
  EdgeScene slides;
  slides.parallel = true, slides.held = true;
  slides.law.fs = slides.law.fd = 0.9, slides.law.vc = 0.01;
  slides.build();
  slides.come(Vec(0, 0.1, 0));
  for (int n = 0; n < 5; ++n) slides.step(0.01);
  const Vec n =
      (slides.world.nodes.x.vec(0) - slides.world.nodes.x.vec(2)).cwiseProduct(Vec(0, 1, 1)).normalized();
  const Vec force = slides.on_a();
  EXPECT_NEAR((force - force.dot(n) * n).norm(), 0.01 * 0.8 * 0.2, 1e-12);
}

}  // namespace edge_touch_test
