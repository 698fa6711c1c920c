// A touch as a whole: forces in balance, what each option does to them, and what the contact reports of it.
#include <gtest/gtest.h>

#include <cmath>

#include "state/shared_fields.hpp"
#include "touch_scene.hpp"

using namespace courant;

namespace touch_balance_test {
namespace {

constexpr Real k = 2.5;  // 0.1 of 25, which the node's own face has

void set_velocity(TouchScene& scene, const Vec& v) {
  for (Index n = 4; n < 8; ++n) scene.world.nodes.v.set(n, v);
}
/// The node comes 0.004 deep, and then goes on at `v`.
void come(TouchScene& scene, const Vec& v) {
  scene.step(0), scene.step(0.005);
  set_velocity(scene, v);
  scene.step(1e-4);
}
struct Balance {
  Vec force = Vec::Zero(), moment = Vec::Zero();
};
/// Of what node and corners get.
Balance balance_of(const TouchScene& scene) {
  Balance out;
  for (Index n = 0; n < 5; ++n) {
    const Vec f = scene.force_on(n);
    out.force += f, out.moment += scene.world.nodes.x.vec(n).cross(f);
  }
  return out;
}
EnergyLedger recorded(TouchScene& scene) {
  EnergyLedger ledger;
  scene.contact->record(scene.world, scene.clock, ledger);
  return ledger;
}

}  // namespace

// Whether the surface lies within the step or not, over the face or beside its edge, slowly or so fast that
// only a part of the force acts: no force and no moment is left. Round-off of forces up to 1.
TEST(TouchBalance, NeitherForceNorMomentIsLeft) {
  int partial = 0, beside = 0;
  for (const Real at : {0.5, 1.02, 1.05, 1.06, 1.065})
    for (const Real speed : {0.1, 3.0, 8.0, -3.0})
      for (const Real vdc : {0.0, 20.0}) {
        if (vdc > 0 && at > 1.04) continue;  // damping acts at the foot, not at the node
        TouchScene scene;
        scene.held = false, scene.at = Vec(0.9, 0.2, 0.001), scene.law.vdc = vdc;
        scene.change = [](ContactSides& sides) { sides.faces[0].k = 1e5, sides.own[0].k = 1e5; };
        scene.build();
        scene.step(0), scene.step(0.021);
        Nodes& nodes = scene.world.nodes;
        constexpr Real dt = 1e-2;
        const Vec v(0, 0, speed), shift = Vec(at, 0.2, -0.02) - dt * v - nodes.x.vec(4);
        for (Index n = 4; n < 8; ++n) nodes.v.set(n, v), nodes.x.add(n, shift);
        scene.step(dt);
        const Balance left = balance_of(scene);
        const Real size = scene.force_on(4).norm();
        EXPECT_NEAR(left.force.norm(), 0, 1e-12 * (1 + size)) << at << " " << speed;
        EXPECT_NEAR(left.moment.norm(), 0, 1e-12 * (1 + size)) << at << " " << speed;
        partial += size > 0 && std::abs(speed) > 1 && at > 1.04, beside += size > 0 && at > 1.04;
      }
  EXPECT_GT(partial, 0);
  EXPECT_GT(beside, 0);
}

// The corners of the face get the force by N at the foot; the field of its segment what the face gets.
TEST(TouchBalance, FacesGetWhatNodesLose) {
  for (const unsigned pass : {0U, 1U}) {
    TouchScene scene;
    scene.pass = pass;
    scene.build();
    come(scene, Vec::Zero());
    scene.world.segments.contact_force->fill(0);  // which another pass does
    scene.step(1e-4);
    const Real F = k * 0.004, N[4] = {0.25 * 0.5 * 0.8, 0.25 * 1.5 * 0.8, 0.25 * 1.5 * 1.2, 0.25 * 0.5 * 1.2};
    for (Index n = 0; n < 4; ++n) EXPECT_NEAR(scene.force_on(n)[2], -N[n] * F, 1e-14) << n;
    EXPECT_NEAR(scene.world.segments.contact_force->vec(0)[2], -F, 1e-14);
    EXPECT_NEAR(scene.world.maxima["max_penetration"], 0.004, 1e-12);
    NodeContact::Surface node, face;
    node.node.assign(8, 0), node.segment.assign(1, 0), face = node;
    node.node[4] = 1, face.segment[0] = 1;
    EXPECT_NEAR(scene.contact->force_between(node, face)[2], F, 1e-14);
    EXPECT_NEAR(scene.contact->force_between(face, node)[2], -F, 1e-14);
    Vec on_segment = Vec::Zero(), on_node = Vec::Zero();
    scene.contact->report_point_forces(
        scene.world, [&](const PointForce& one) { (one.segment >= 0 ? on_segment : on_node) += one.force; });
    EXPECT_NEAR((on_segment - Vec(0, 0, -F)).norm() + (on_node - Vec(0, 0, F)).norm(), 0, 1e-14);
  }
  TouchScene single;
  single.law.single = true;
  single.build();
  come(single, Vec::Zero());
  EXPECT_EQ(single.contact->report().on_surfa, Vec::Zero());
}

// Damping acts on the difference of the velocities of node and foot: sum N v of corners that differ.
TEST(TouchBalance, DampingSeesTheVelocityOfTheFoot) {
  const auto force = [](bool corners_move) {
    TouchScene scene;
    scene.held = false, scene.law.vdc = 10;
    scene.build();
    come(scene, Vec(0, 0, corners_move ? 0 : -0.1));
    if (!corners_move) return scene.force_on(4)[2];
    const Real N[4] = {0.25 * 0.5 * 0.8, 0.25 * 1.5 * 0.8, 0.25 * 1.5 * 1.2, 0.25 * 0.5 * 1.2};
    scene.world.nodes.v.set(2, Vec(0, 0, 0.1 / N[2]));  // the foot moves up with 0.1
    scene.step(1e-9);
    return scene.force_on(4)[2];
  };
  EXPECT_NEAR(force(true), force(false) - k * 1e-5, 1e-8);
}

// Beside an edge, where the force fades, damping acts along the same unit normal: 2 xi sqrt(k m) v.n.
TEST(TouchBalance, DampingBesideAnEdgeIsAlongTheUnitNormal) {
  const auto force = [](Real vdc) {
    TouchScene scene;
    scene.at = Vec(0.9, 0.2, 0.001), scene.law.vdc = vdc;
    scene.build();
    scene.step(0), scene.step(0.021);
    const Vec v(0.05, 0, -0.1), to = Vec(1.055, 0.2, -0.02) - 1e-6 * v - scene.world.nodes.x.vec(4);
    for (Index n = 4; n < 8; ++n) scene.world.nodes.v.set(n, v), scene.world.nodes.x.add(n, to);
    scene.step(1e-6);
    return scene.force_on(4);
  };
  const Vec plain = force(0), damping = force(10) - plain, n = plain.normalized();
  EXPECT_NEAR((damping + 2 * 0.1 * std::sqrt(k) * Vec(0.05, 0, -0.1).dot(n) * n).norm(), 0, 1e-9);
}

// Beside a held face the node has the spring alone: 2 xi sqrt(k m) v.
TEST(TouchBalance, HeldFacesAreOfNoMassInDamping) {
  for (const Real m : {1.0, 30.0}) {
    TouchScene scene;
    scene.law.vdc = 10;
    scene.build();
    scene.world.nodes.m[4] = m;
    come(scene, Vec(0, 0, -0.1));
    EXPECT_NEAR(scene.force_on(4)[2], k * (0.004 + 1e-5) + 2 * 0.1 * std::sqrt(k * m) * 0.1, 1e-12) << m;
  }
}

// The friction is at most FS of push and damping together.
TEST(TouchBalance, FrictionIsBoundedByPushAndDamping) {
  TouchScene scene;
  scene.held = false, scene.law.vdc = 50, scene.law.fs = scene.law.fd = 0.3;
  scene.build();
  come(scene, Vec(2, 0, -0.1));
  for (int n = 0; n < 40; ++n) scene.step(1e-3);
  const Vec f = scene.force_on(4);
  EXPECT_GT(f[2], 1.2 * k * 0.008) << "damping acts";
  EXPECT_NEAR(-f[0], 0.3 * f[2], 1e-12);
}

// A face that comes up to a node at rest touches it as a node that comes down does.
TEST(TouchBalance, FacesMayComeToNodes) {
  TouchScene scene;
  scene.held = false, scene.v = Vec::Zero();
  scene.build();
  scene.step(0);
  Nodes& nodes = scene.world.nodes;
  for (Index n = 0; n < 4; ++n) nodes.v.set(n, Vec(0, 0, 1)), nodes.x.add(n, Vec(0, 0, 0.045));
  scene.step(0.045);  // further in than what is taken for a touch that was missed, 0.02 of the depth of 2
  EXPECT_NEAR(scene.force_on(4)[2], k * 0.044, 0.5 * k * 0.044) << "a part of it, as it came within the step";
  EXPECT_GT(scene.force_on(4)[2], 0);
  for (Index n = 0; n < 4; ++n) nodes.v.set(n, Vec::Zero());
  scene.step(1e-6);
  EXPECT_NEAR(scene.force_on(4)[2], k * 0.044, 1e-12);
}

// What is behind the face at the start gives no force; as it comes out, the depth that gives none follows it.
TEST(TouchBalance, DepthOfTheStartGivesNoForce) {
  TouchScene scene;
  scene.at = Vec(0.5, 0.2, -0.004), scene.v = Vec::Zero();
  scene.build();
  scene.step(0);
  EXPECT_EQ(scene.force_on(4)[2], 0);
  set_velocity(scene, Vec(0, 0, 1));
  scene.step(0.003);
  EXPECT_EQ(scene.force_on(4)[2], 0) << "0.001 deep still";
  set_velocity(scene, Vec(0, 0, -0.1));
  scene.step(0.02);
  EXPECT_NEAR(scene.force_on(4)[2], k * 0.002, 1e-12) << "0.003 deep, of which 0.001 give no force";
  EXPECT_NEAR(scene.contact->report().energy_stored, 0.5 * k * 0.002 * 0.002, 1e-15);
}

// Of own faces of a node those that look at the face count by the cosine, those of shells from both sides;
// none below a tenth. VC acts on the same share of their areas.
TEST(TouchBalance, OwnFacesCountAsFarAsTheyLookAtTheOther) {
  struct Case {
    Real angle;
    bool shell;
    Real share;
  };
  for (const Case& one : {Case{0, false, 1},
                          {60, false, 0.5},
                          {60, true, 0.5},
                          {180, false, 0.1},
                          {180, true, 1},
                          {120, true, 0.5}}) {
    TouchScene scene;
    scene.law.fs = scene.law.fd = 10, scene.law.vc = 0.001;
    scene.change = [&](ContactSides& sides) {
      sides.own[0].two_sided = one.shell;
      sides.own.push_back(sides.own[0]);
      sides.nodes[0].last = 2;
    };
    scene.build();
    Nodes& nodes = scene.world.nodes;
    const Matrix turn = Eigen::AngleAxisd(one.angle * pi / 180, Vec::UnitX()).toRotationMatrix();
    for (Index n = 5; n < 8; ++n) nodes.x.set(n, nodes.x.vec(4) + turn * (nodes.x.vec(n) - nodes.x.vec(4)));
    come(scene, Vec::Zero());
    EXPECT_NEAR(scene.force_on(4)[2], 2 * one.share * k * 0.004, 1e-12) << one.angle << one.shell;
    if (one.angle >= 100 && !one.shell) continue;
    set_velocity(scene, Vec(1, 0, 0));
    for (int n = 0; n < 3; ++n) scene.step(0.01);
    EXPECT_NEAR(-scene.force_on(4)[0], 0.001 * 2 * 0.25 * one.share, 1e-14) << one.angle << one.shell;
  }
}

// SOFT 1 makes contact stiffer where the masses are large, and never softer.
TEST(TouchBalance, SoftOneTakesTheStifferOfBoth) {
  for (const Real dtstif : {0.01, 10.0}) {
    TouchScene scene;
    scene.held = false, scene.law.soft = 1, scene.law.dtstif = dtstif, scene.law.sofscl = 0.2;
    scene.build();
    come(scene, Vec::Zero());
    const Real soft = 0.2 * 0.5 * 1 / (dtstif * dtstif);
    EXPECT_NEAR(scene.force_on(4)[2], std::max(soft, k) * 0.004, 1e-10) << dtstif;
  }
}

// ENMASS 1: nodes of solids that are deleted go on to touch, those of shells do not; 2: all; 0: none.
TEST(TouchBalance, NodesOfDeletedElementsTouchByEnmass) {
  for (const int enmass : {0, 1, 2})
    for (const bool shell : {false, true}) {
      TouchScene scene;
      scene.law.enmass = enmass;
      scene.change = [&](ContactSides& sides) { sides.own[0].two_sided = shell, sides.own[0].segment = 1; };
      scene.world.segments.fields.resize(2);
      Field<Index>& eroded = shared_fields::eroded.add(scene.world.segments.fields);
      scene.build();
      scene.world.segments.fields.resize(2);
      eroded[0] = 0, eroded[1] = shared_fields::deleted;
      come(scene, Vec::Zero());
      EXPECT_EQ(scene.force_on(4)[2] > 0, enmass == 2 || (enmass == 1 && !shell)) << enmass << shell;
    }
}

// Two springs of TSSFAC s and damping xi on one frequency: 2 sqrt(part (1 - s^2)) (sqrt(1 + xi^2) -
// xi)/omega, and omega dt at most s; up to a touch that is due but for such a step, of nine tenths of the
// time.
TEST(TouchBalance, TheStepIsThatOfTheStiffestTouchWithItsDamping) {
  TouchScene scene;
  scene.build();
  const auto limit = [&](Real vdc, Real tssfac, Real part, Real due, Real soon) {
    NodeContactLaw law;
    law.vdc = vdc, law.tssfac = tssfac;
    return limit_of(law, {{100, 4}, {soon, 5}}, due, part, "contact", scene.world).dt;
  };
  const auto allowed = [](Real vdc, Real s, Real part, Real omega2) {
    const Real xi = 0.02 * vdc;
    return std::min(2 * std::sqrt(part * (1 - s * s)) * (std::sqrt(1 + xi * xi) - xi), s) / std::sqrt(omega2);
  };
  for (const Real vdc : {0.0, 20.0, 100.0})
    for (const Real s : {0.5, 0.67, 0.9})
      for (const Real part : {1.0, 0.5}) {
        EXPECT_NEAR(limit(vdc, s, part, 1e9, 100), allowed(vdc, s, part, 100), 1e-12);
        EXPECT_NEAR(limit(vdc, s, part, 1e-9, 1e4), allowed(vdc, s, part, 1e4), 1e-12);
        const Real due = 0.5 * allowed(vdc, s, part, 100);
        const Real then = allowed(vdc, s, part, 1e4);
        EXPECT_NEAR(limit(vdc, s, part, due, 1e4), std::max(0.9 * due - then, then), 1e-12);
      }
}

// Mean velocities of the step to come: of nodes by their forces, of bodies by what the bodies do, half of the
// change; what is held or driven has its own.
TEST(TouchBalance, MiddleVelocitiesAreThoseOfHalfTheChange) {
  TouchScene scene;
  scene.build();
  Nodes& nodes = scene.world.nodes;
  scene.clock.dt = 0.03, scene.clock.dt_old = 0.01;
  nodes.held[5] = 1;
  for (Index n = 4; n < 8; ++n) nodes.v.set(n, Vec(1, 2, 3)), nodes.f.set(n, Vec(4, 0, -4));
  WallBodies bodies;
  bodies.of_node.assign(8, -1), bodies.of_node[6] = 0;
  bodies.change = [](Index, const Vec& q, const Clock&) { return Vec(q + Vec(0, 0, 1)); };
  shared_fields::prescribed_motion.add(nodes.fields)[7] = 1;
  const DrivenPoints driven(nodes.fields);
  const auto v = [&](Index n) { return middle_velocity(scene.world, bodies, scene.clock, driven, n); };
  EXPECT_NEAR((v(4) - Vec(1, 2, 3) - 0.5 * 0.02 * Vec(4, 0, -4)).norm(), 0, 1e-14);
  EXPECT_EQ(v(5), Vec(1, 2, 3));
  EXPECT_NEAR((v(6) - Vec(1, 2, 3) - 0.5 * (nodes.x.vec(6) + Vec(0, 0, 1))).norm(), 0, 1e-14);
  EXPECT_EQ(v(7), Vec(1, 2, 3));
}

// A touch that comes within a step has its spring counted before: as soon as the gap of both thicknesses is
// less than what the node goes in a step.
TEST(TouchBalance, WhatComesIsCountedFromItsThickness) {
  for (const Real gap : {0.005, 0.0005}) {
    TouchScene scene;
    scene.at = Vec(0.5, 0.2, 0.1 + gap + 0.0011), scene.v = Vec(0, 0, -1);
    scene.change = [](ContactSides& sides) { sides.faces[0].r = 0.06, sides.nodes[0].r = 0.04; };
    scene.build();
    scene.step(0), scene.step(1e-4), scene.step(1e-3);
    EXPECT_EQ(scene.force_on(4)[2], 0);
    EXPECT_EQ(std::isfinite(scene.contact->limit(scene.world, scene.clock).dt), gap < 1e-3) << gap;
    scene.step(3e-3 + gap);
    EXPECT_NEAR(scene.contact->report().energy_stored, 0.5 * k * 9e-6, 1e-12) << gap;
  }
}

// Behind a death a birth begins again: what was in touch then is forgotten, and what is inside gives no
// force.
TEST(TouchBalance, NothingOfATouchIsLeftBehindItsDeath) {
  TouchScene scene;
  scene.law.fs = scene.law.fd = 0.5, scene.law.death = 1;
  scene.build();
  come(scene, Vec(0.1, 0, 0));
  scene.step(0.01);
  ASSERT_NE(scene.force_on(4)[0], 0);
  scene.clock.t = 2;
  scene.step(1e-4);
  EXPECT_EQ(scene.force_on(4), Vec::Zero());
  EXPECT_GT(recorded(scene).dissipated, 0);
  scene.clock.t = 0.5;
  scene.step(1e-4);
  EXPECT_EQ(scene.force_on(4), Vec::Zero());
  EXPECT_EQ(scene.contact->report().energy_stored, 0);
}

// Friction ends with the touch: one that begins later starts from 0.
TEST(TouchBalance, FrictionIsForgottenWhereATouchOpens) {
  TouchScene scene;
  scene.law.fs = scene.law.fd = 0.5;
  scene.at = Vec(0.5, 0.2, -0.004), scene.v = Vec::Zero();  // 0.004 of depth give no force: the touch stays
  scene.build();
  scene.step(0);
  set_velocity(scene, Vec(0, 0, -1));
  scene.step(0.004);
  set_velocity(scene, Vec(0.1, 0, 0));
  scene.step(0.01);
  ASSERT_NEAR(scene.force_on(4)[0], -k * 0.001, 1e-12);
  set_velocity(scene, Vec(0, 0, 1));
  scene.step(0.005);
  EXPECT_EQ(scene.force_on(4), Vec::Zero());
  set_velocity(scene, Vec(0, 0, -1));
  scene.step(0.003);
  EXPECT_NEAR(scene.force_on(4)[0], 0, 1e-14);
}

}  // namespace touch_balance_test
