// What one touch of a node with a face does: damping, friction, stiffness, edges, energies, by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "state/shared_fields.hpp"
#include "touch_scene.hpp"

using namespace courant;

namespace {

/// Masses of the node and, along the normal, of the free face at its position: 1/sum N^2/m.
Real mass_of_face(const TouchScene& scene) {
  const Real N[4] = {0.25 * 0.5 * 0.8, 0.25 * 1.5 * 0.8, 0.25 * 1.5 * 1.2, 0.25 * 0.5 * 1.2};
  Real mobility = 0;
  for (Index n = 0; n < 4; ++n) mobility += N[n] * N[n] / scene.world.nodes.m[n];
  return 1 / mobility;
}
void set_velocity(TouchScene& scene, const Vec& v) {
  for (Index n = 4; n < 8; ++n) scene.world.nodes.v.set(n, v);
}
/// The node comes 0.004 deep, and then goes on so slowly that the surface lies not within a step.
void come(TouchScene& scene, const Vec& v) {
  scene.step(0), scene.step(0.005);
  set_velocity(scene, v);
  scene.step(1e-4);
}
EnergyLedger recorded(TouchScene& scene) {
  EnergyLedger ledger;
  scene.contact->record(scene.world, scene.clock, ledger);
  return ledger;
}

}  // namespace

// k d - 2 xi m omega v: m the lighter of node and face, omega of the spring between both.
TEST(NodeContactTouch, DampsByTheLighterSideAtTheFrequencyOfBoth) {
  for (const Real m : {1.0, 30.0}) {
    TouchScene scene;
    scene.held = false, scene.law.vdc = 20;
    scene.build();
    scene.world.nodes.m[4] = m;
    come(scene, Vec(0, 0, -0.1));
    const Real face = mass_of_face(scene), k = 2.5, omega = std::sqrt(k * (1 / m + 1 / face));
    const Real damping = 2 * 0.2 * std::min(m, face) * omega * 0.1;
    EXPECT_NEAR(scene.force_on(4)[2], k * (0.004 + 1e-5) + damping, 1e-12) << m;
    const EnergyLedger ledger = recorded(scene);  // nothing else pushes: v stays
    EXPECT_NEAR(ledger.dissipated, damping * 0.1 * 1e-4, 1e-15) << m;
    EXPECT_NEAR(scene.contact->report().energy_damping, damping * 0.1 * 1e-4, 1e-15) << m;
  }
}

TEST(NodeContactTouch, DampingNeverPulls) {
  TouchScene scene;
  scene.law.vdc = 100;
  scene.build();
  come(scene, Vec(0, 0, 1));
  EXPECT_EQ(scene.force_on(4)[2], 0);
}

// FS is 0.5, FD 0.2, DC 3: mu at a slip of 0.1 is 0.2 + 0.3 exp(-0.3); VC a stress on the 0.25 of the node.
TEST(NodeContactTouch, FrictionFallsWithTheSlipAndIsBoundedByAStress) {
  for (const Real vc : {0.0, 0.004}) {
    TouchScene scene;
    scene.law.fs = 0.5, scene.law.fd = 0.2, scene.law.dc = 3, scene.law.vc = vc;
    scene.build();
    come(scene, Vec(0.1, 0, 0));
    for (int k = 0; k < 3; ++k) scene.step(0.01);
    const Real most = (0.2 + 0.3 * std::exp(-0.3)) * 2.5 * 0.004;
    EXPECT_NEAR(scene.force_on(4)[0], vc > 0 ? -0.25 * vc : -most, 1e-14) << vc;
    EXPECT_LT(0.25 * 0.004, most);
  }
}

// What a face turns under the node turns the spring of friction with it, and keeps its size.
TEST(NodeContactTouch, FrictionTurnsWithTheFace) {
  TouchScene scene;
  scene.at = Vec(0, 0, 0.001);
  scene.law.fs = scene.law.fd = 0.5;
  scene.build();
  come(scene, Vec(0.1, 0, 0));
  scene.step(0.01);
  const Real before = std::abs(scene.force_on(4)[0]);
  set_velocity(scene, Vec::Zero());
  const Real turn = 0.3;
  const Vec foot(scene.world.nodes.x.vec(4)[0], 0, 0);
  for (Index n = 0; n < 4; ++n) {
    const Vec r = scene.world.nodes.x.vec(n) - foot;
    scene.world.nodes.x.set(n, foot + Vec(Eigen::AngleAxisd(turn, Vec::UnitY()) * r));
  }
  scene.step(1e-4);
  const Vec n(std::sin(turn), 0, std::cos(turn)), along(std::cos(turn), 0, -std::sin(turn));
  EXPECT_NEAR(scene.force_on(4).dot(along), -before, 1e-12);
}

// Of SURFB, its force counts for SURFB: on SURFA is what the face gets.
TEST(NodeContactTouch, TellsTheForceOnSurfa) {
  for (const unsigned pass : {0U, 1U}) {
    TouchScene scene;
    scene.pass = pass;
    scene.build();
    come(scene, Vec::Zero());
    EXPECT_NEAR(scene.contact->report().on_surfa[2], (pass == 0 ? 1 : -1) * 2.5 * 0.004, 1e-14);
  }
}

// The node's faces have 25, the face 100, times SLSFAC 0.1 and the scale of the node's own side.
TEST(NodeContactTouch, StiffnessIsChosenByPenoptAndScaledBySide) {
  for (const auto& [penopt, k] : {std::pair(1, 2.5), {2, 10.0}, {3, 2.5}})
    for (const unsigned pass : {0U, 1U}) {
      TouchScene scene;
      scene.pass = pass, scene.law.penopt = penopt, scene.law.sfs = {2, 3};
      scene.build();
      come(scene, Vec::Zero());
      EXPECT_NEAR(scene.force_on(4)[2], (pass == 0 ? 2 : 3) * k * 0.004, 1e-14) << penopt << pass;
    }
}

TEST(NodeContactTouch, SoftOneFollowsTheLightestCorner) {
  TouchScene scene;
  scene.held = false, scene.law.soft = 1, scene.law.dtstif = 0.01, scene.law.sofscl = 0.2;
  scene.build();
  scene.world.nodes.m[2] = 0.5;
  come(scene, Vec::Zero());
  EXPECT_NEAR(scene.force_on(4)[2], 0.2 * 0.5 * 0.5 / 1e-4 * 0.004, 1e-12);
}

// Work of friction on what slides: of the mean velocities of a step, in which forces act, of both sides; of
// what is driven its own. What springs of friction hold is not lost yet.
TEST(NodeContactTouch, FrictionWorksBetweenBothSides) {
  for (const bool driven : {false, true}) {
    TouchScene scene;
    scene.held = false, scene.law.fs = scene.law.fd = 0.5;
    scene.build();
    if (driven) shared_fields::prescribed_motion.add(scene.world.nodes.fields)[4] = 1;
    come(scene, Vec(0.1, 0, 0));
    for (int k = 0; k < 3; ++k) scene.step(0.01);
    Nodes& nodes = scene.world.nodes;
    for (Index n = 0; n < 4; ++n) nodes.v.set(n, Vec(-0.02, 0, 0)), nodes.f.set(n, Vec(3, 0, 0));
    nodes.f.set(4, Vec(-2, 0, 0));
    const Vec force(scene.force_on(4)[0], scene.force_on(4)[1], 0);
    ASSERT_NEAR(force[0], -0.5 * 2.5 * 0.004, 1e-14);
    const Real dt = scene.clock.dt_mean();
    const Real v = 0.1 - (driven ? 0 : 0.5 * dt * 2 / nodes.m[4]), of_face = -0.02 + 0.5 * dt * 3 / 2;
    const Real work = -force[0] * (v - of_face) * dt;
    EXPECT_NEAR(recorded(scene).dissipated, work, 1e-15) << driven;
    EXPECT_NEAR(scene.contact->report().energy_friction, work - 0.5 * force[0] * force[0] / 2.5, 1e-15);
  }
}

// CNTCO: thickness counts from planes that are `lift` off the nodes along the normals, z of the face and -z
// of the node's own one. Both at z = 0: they touch at 0.03 + 0.03, more where a plane lies on the side of the
// other.
TEST(NodeContactTouch, CountsThicknessFromLiftedPlanes) {
  for (const Real side : {1, -1})
    for (const Real of_face : {-0.02, 0.0, 0.02})
      for (const Real of_node : {-0.01, 0.0, 0.01}) {
        TouchScene scene;
        scene.at = Vec(0.5, 0.2, side * 0.1), scene.v = Vec(0, 0, -side);
        scene.change = [&](ContactSides& sides) {
          sides.faces[0].two_sided = sides.own[0].two_sided = true;
          sides.faces[0].r = sides.nodes[0].r = 0.03;
          sides.faces[0].lift = of_face, sides.own[0].lift = of_node;
          sides.nodes[0].most_lift = std::abs(of_node);
        };
        scene.build();
        scene.step(0), scene.step(0.08);
        const Real depth = 0.06 + side * (of_face + of_node) - 0.02;
        EnergyLedger ledger;
        scene.contact->sample(scene.world, scene.clock, ledger);
        EXPECT_NEAR(ledger.contact, 0.5 * 2.5 * depth * depth, 1e-14) << side << of_face << of_node;
        EXPECT_GT(side * scene.force_on(4)[2], 0);
      }
}

// A face whose thickness is all above its nodes: what lies flush below it, by rounding on either side, is
// held there.
TEST(NodeContactTouch, HoldsWhatIsFlushWithALiftedFace) {
  for (const Real side : {1, -1})
    for (const Real off : {-1e-9, 1e-9}) {
      TouchScene scene;
      scene.at = Vec(0.5, 0.2, off), scene.v = Vec(0, 0, side);
      scene.change = [&](ContactSides& sides) {
        sides.faces[0].two_sided = sides.own[0].two_sided = true;
        sides.faces[0].r = 0.03, sides.faces[0].lift = side * 0.03;
      };
      scene.build();
      scene.step(0), scene.step(0.01);
      EXPECT_NEAR(scene.force_on(4)[2], -side * 2.5 * 0.01, 1e-7) << side << off;
    }
}

// What its spring holds where it goes through is dissipated, so that the balance closes.
TEST(NodeContactTouch, LosesWhatItStoresByALeak) {
  TouchScene scene;
  scene.build();
  come(scene, Vec(0, 0, -1));
  EXPECT_EQ(recorded(scene).dissipated, 0);
  scene.step(2.1);
  EXPECT_EQ(scene.world.counters.at("leaked_nodes"), 1);
  const Real depth = 0.004 + 1e-4 + 2.1;
  const EnergyLedger ledger = recorded(scene);
  EXPECT_NEAR(ledger.dissipated, 0.5 * 2.5 * depth * depth, 1e-12);
  EXPECT_EQ(ledger.throughput, ledger.dissipated);
  EXPECT_EQ(recorded(scene).dissipated, 0) << "once";
}

// At its death what it stores is lost, and told as its own.
TEST(NodeContactTouch, LosesWhatItStoresAtItsDeath) {
  TouchScene scene;
  scene.law.death = 1;
  scene.build();
  come(scene, Vec::Zero());
  const Real stored = 0.5 * 2.5 * 0.004 * 0.004;
  EnergyLedger ledger;
  scene.contact->sample(scene.world, scene.clock, ledger);
  EXPECT_NEAR(ledger.contact, stored, 1e-16);
  EXPECT_EQ(recorded(scene).dissipated, 0);
  scene.clock.t = 1.1;
  scene.step(1e-4);
  EXPECT_EQ(scene.force_on(4).norm(), 0);
  EXPECT_NEAR(recorded(scene).dissipated, stored, 1e-16);
  EXPECT_NEAR(scene.contact->report().energy_damping, stored, 1e-16);
  EXPECT_EQ(recorded(scene).dissipated, 0) << "once";
}

// A node that comes 0.02 deep beside the face: what the touch stores is the potential of all of its forces,
// on the node and on each corner, wherever it is on its way off the edge.
TEST(NodeContactTouch, ForcesBesideAnEdgeAreTheSlopesOfItsEnergy) {
  struct Moved {
    Real stored = 0;
    std::array<Vec, 5> force{};
  };
  const auto at = [](Real beyond, Index who, const Vec& shift) {
    TouchScene scene;
    scene.held = false, scene.at = Vec(0.9, 0.2, 0.001);
    scene.build();
    scene.step(0);
    scene.step(0.021);
    Nodes& nodes = scene.world.nodes;
    for (Index n = 4; n < 8; ++n) nodes.v.set(n, Vec::Zero());
    const Vec to(1 + beyond, 0.2, -0.02);
    const Vec way = to - nodes.x.vec(4);
    for (Index n = 4; n < 8; ++n) nodes.x.add(n, way);
    nodes.x.add(who, shift);
    scene.step(1e-6);
    Moved out;
    out.stored = scene.contact->report().energy_stored;
    for (Index n = 0; n < 5; ++n) out.force[static_cast<std::size_t>(n)] = scene.force_on(n);
    return out;
  };
  int faded = 0;
  for (int k = 1; k < 40; ++k) {
    const Real beyond = 0.0495 + 0.001 * k;  // the push begins to fade at 0.05
    const Moved here = at(beyond, 4, Vec::Zero());
    if (!(here.stored > 0)) break;
    faded += here.stored < 0.98 * 0.5 * 2.5 * 4e-4;
    constexpr Real step = 1e-7;
    for (Index who = 0; who < 5; ++who)
      for (int axis = who < 4 ? 2 : 0; axis < 3; ++axis) {  // corners across the face, as it turns
        const Vec shift = step * Vec::Unit(axis);
        const Real slope = (at(beyond, who, shift).stored - at(beyond, who, -shift).stored) / (2 * step);
        EXPECT_NEAR(here.force[static_cast<std::size_t>(who)][axis], -slope, 1e-6)
            << beyond << " " << who << " " << axis;
      }
  }
  EXPECT_GT(faded, 3);
}

// Two thick shells that share a corner and fold over each other, as in a crushed rail: the node is in front
// of one, by nearly its thickness, and 8.5 behind the other, to which the touch goes on. It brings no energy;
// the spring acts on what comes from there on.
TEST(NodeContactTouch, GoesOnToAFaceThatFoldsOverWithoutEnergy) {
  TouchScene scene;
  scene.v = Vec::Zero();
  const std::array<Vec, 3> folded{Vec(747.5870, 1352.4696, 270.0288), Vec(754.6511, 1317.7870, 259.9147),
                                  Vec(711.1067, 1342.8418, 252.8689)};
  scene.change = [&](ContactSides& sides) {
    const std::array<Vec, 5> flat{Vec(752.6287, 1323.1897, 291.4188), Vec(737.9103, 1323.5800, 252.9814),
                                  Vec(744.8561, 1344.8067, 257.1064), Vec(722.6765, 1342.8824, 255.8249),
                                  Vec(746.8914, 1325.7344, 263.6393)};
    for (std::size_t n = 0; n < 5; ++n) scene.world.nodes.x.set(static_cast<Index>(n), flat[n]);
    for (std::size_t n = 0; n < 3; ++n)
      scene.world.nodes.x.set(static_cast<Index>(5 + n), folded[n] - Vec(0, 0, 100));
    const ContactFace shell{.node = {0, 1, 2, 3},
                            .two_sided = true,
                            .r = 2.5,
                            .k = 100,
                            .area = 500,
                            .depth = 5,
                            .through = 20,
                            .passes = 1};
    sides.faces = {shell, shell};
    sides.faces[1].node = {2, 5, 6, 7};
    sides.own.clear();
    sides.nodes[0].last = 0, sides.nodes[0].r = 2.5;
  };
  scene.build();
  scene.step(0);
  EXPECT_TRUE(scene.contact->touches_something());
  for (std::size_t n = 0; n < 3; ++n) scene.world.nodes.x.set(static_cast<Index>(5 + n), folded[n]);
  for (int k = 0; k < 3; ++k) {
    scene.step(1e-5);
    EXPECT_NEAR(scene.force_on(4).norm(), 0, 1e-9);
  }
  EXPECT_EQ(scene.world.counters["contact_depth_jumps"], 1);
  scene.world.nodes.v.set(4, Vec(-0.3516, -0.2888, 0.8905));
  scene.step(0.01);
  EXPECT_NEAR(scene.force_on(4).norm(), 10 * 0.01, 1e-3);
}
