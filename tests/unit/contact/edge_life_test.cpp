// When edges touch and when not, the steps they allow, and what they report.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "edge_scene.hpp"
#include "state/shared_fields.hpp"

using namespace courant;

namespace edge_life_test {
namespace {

using test::edges::EdgeScene;
using test::edges::k;

constexpr Real never = std::numeric_limits<Real>::infinity();

}  // namespace

// Between BIRTH and DEATH alone; what it stores at its death is lost.
TEST(EdgeLife, BirthAndDeath) {
  EdgeScene s;
  s.law.birth = 1, s.law.death = 2, s.gap = 0.01;
  s.build();
  const auto go_to = [&](Real z, Real t) {
    for (const Index n : {0, 1}) {
      Vec x = s.world.nodes.x.vec(n);
      x[2] = 2 * test::edges::r + z;
      s.world.nodes.x.set(n, x), s.world.nodes.v.set(n, Vec(0, 0, -1e-9));
    }
    s.clock.t = t;
    s.step(1e-4);
    return s.on_a()[2];
  };
  EXPECT_EQ(go_to(0.001, 0.5), 0);
  EXPECT_EQ(go_to(-0.004, 0.9), 0) << "not yet";
  EXPECT_EQ(s.world.counters["penetrations_at_birth"], 0);
  EXPECT_NEAR(go_to(-0.004, 1.1), 0, 1e-9) << "as deep as at its birth";
  EXPECT_EQ(s.world.counters["penetrations_at_birth"], 1);
  EXPECT_NEAR(go_to(-0.009, 1.5), k * 0.005, 1e-7);
  const Real stored = 0.5 * k * 0.005 * 0.005;
  EXPECT_NEAR(s.sampled().contact, stored, 1e-9);
  EXPECT_EQ(s.recorded().dissipated, 0);
  EXPECT_EQ(go_to(-0.009, 2.1), 0) << "no more";
  EXPECT_EQ(s.sampled().contact, 0);
  EXPECT_EQ(s.contact->limit(s.world, s.clock).dt, never);
  const EnergyLedger ledger = s.recorded();
  EXPECT_NEAR(ledger.dissipated, stored, 1e-9);
  EXPECT_NEAR(ledger.throughput, stored, 1e-9);
  EXPECT_EQ(s.recorded().dissipated, 0) << "once";
  EXPECT_NEAR(s.contact->report().energy_damping, stored, 1e-9);
  EXPECT_EQ(s.contact->report().energy_stored, 0);
}

// Springs of 4e9: omega^2 is at most k sum |share| share/m, 0.7 of both edges at the first node; a step
// before it nine tenths of the gap. What came and went does not count when something else comes.
TEST(EdgeLife, AllowsAStepUpToTheTouch) {
  EdgeScene s;
  s.law.slsfac = 1e8;
  s.build();
  const Real of_springs = 2 * std::sqrt(0.19 / (4e9 * 0.7 * 2));
  const auto limit = [&] { return s.contact->limit(s.world, s.clock).dt; };
  const auto go = [&](Real v, Real dt) {
    for (const Index n : {0, 1}) s.world.nodes.v.set(n, Vec(0, 0, v));
    s.step(dt);
  };
  go(-1, 0);
  EXPECT_NEAR(limit(), 0.9 * 0.001 - of_springs, 1e-9) << "no step is known, so it may come in the next";
  go(-1, 0.0006);  // 0.0004 away
  EXPECT_NEAR(limit(), 0.9 * 0.0004 - of_springs, 1e-9);
  EXPECT_EQ(s.on_a(), Vec::Zero());
  go(1, 0.0006);
  EXPECT_EQ(limit(), never);
  go(-0.5, 0.0006);
  EXPECT_EQ(limit(), never) << "0.0007 away, further than the longest step so far leads";
  go(-0.5, 0.0008);  // 0.0003 away, in 0.0006
  EXPECT_NEAR(limit(), 0.9 * 0.0006 - of_springs, 1e-9);
  go(-0.5, 0.0007);  // it touches
  EXPECT_NEAR(limit(), of_springs, 1e-9);
  EXPECT_GT(s.on_a()[2], 0);
}

// The first face of each edge that is there takes its force, and points of forces are its nodes.
TEST(EdgeLife, FacesTakeTheForcesOfTheirEdges) {
  for (const bool deleted : {false, true}) {
    EdgeScene s;
    if (deleted) shared_fields::eroded.add(s.world.segments.fields);
    s.build();
    if (deleted) (*shared_fields::eroded.find(s.world.segments.fields))[1] = shared_fields::hidden;
    s.come(Vec::Zero());
    if (deleted && s.on_a().norm() == 0) continue;  // an edge without a face does not touch
    const Vec F(0, 0, k * 0.004);
    const Field<Real>& on_faces = *s.world.segments.contact_force;
    EXPECT_NEAR((on_faces.vec(0) - 3 * F).norm(), 0, 3) << "of the steps that were";
    EXPECT_NEAR((on_faces.vec(0) + on_faces.vec(1)).norm(), 0, 1e-14);
    Vec on[2] = {Vec::Zero(), Vec::Zero()}, moment = Vec::Zero();
    int count = 0;
    s.contact->report_point_forces(s.world, [&](const PointForce& one) {
      ++count, on[one.segment] += one.force, moment += one.point.cross(one.force);
    });
    EXPECT_EQ(count, 4);
    EXPECT_NEAR((on[0] - F).norm() + (on[1] + F).norm() + moment.norm(), 0, 1e-14);
  }
}

// Of one side alone, with a node in common, or held at all ends: they do not touch.
TEST(EdgeLife, WhatDoesNotTouch) {
  struct Case {
    std::array<unsigned, 2> sides;
    bool touch;
  };
  for (const Case& one : {Case{{1, 2}, true},
                          {{2, 1}, true},
                          {{1, 1}, false},
                          {{2, 2}, false},
                          {{3, 3}, true},
                          {{1, 3}, true}}) {
    EdgeScene s;
    s.sides = one.sides;
    s.build();
    s.come(Vec::Zero());
    EXPECT_EQ(s.on_a().norm() > 0, one.touch) << one.sides[0] << one.sides[1];
  }
  for (const Index free : {-1, 0, 1, 2, 3}) {
    EdgeScene s;
    s.build();
    for (Index n = 0; n < 4; ++n) s.world.nodes.held[n] = n != free;
    s.come(Vec::Zero());
    EXPECT_EQ(s.on_a().norm() > 0, free >= 0) << free;
  }
}

// Those that are nearer than both radii before the run are counted, with the deepest and its first node.
TEST(EdgeLife, PenetrationsOfTheStart) {
  for (const Real gap : {0.001, -0.003}) {
    EdgeScene s;
    s.gap = gap;
    s.build();
    const auto found = s.contact->penetrations(s.world);
    EXPECT_EQ(found.count, gap < 0 ? 1 : 0);
    EXPECT_NEAR(found.deepest, gap < 0 ? 0.003 : 0, 1e-12);
    EXPECT_EQ(found.node, gap < 0 ? 1 : 0);
  }
  EdgeScene later;
  later.gap = -0.003, later.law.birth = 1;
  later.build();
  EXPECT_EQ(later.contact->penetrations(later.world).count, 0) << "counted at its birth";
}

}  // namespace edge_life_test
