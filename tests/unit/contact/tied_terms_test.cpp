// Springs and constraints between a node and a face, by hand: forces, damage, energies, what is reported.
#include <gtest/gtest.h>

#include <cmath>

#include "../../verification/shells/shell_decks.hpp"
#include "../../verification/structures/solid_decks.hpp"
#include "contact/tied/springs.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

using namespace courant;

namespace tied_terms_test {
namespace {

using test::do_nothing;
using test::simulation_of;

constexpr Real k = 50, area = 0.25;

/// A node at a gap above a face of side 2 in z = 0, tied by a spring.
struct TiedScene {
  World world;
  Clock clock;
  Force* springs = nullptr;
  Real gap = 0.1;

  explicit TiedScene(const TieStrength& strength, Real side = 1, Real death = 1e20) {
    Nodes& nodes = world.nodes;
    nodes.fields.resize(5);
    const Vec x[5] = {Vec(-1, -1, 0), Vec(1, -1, 0), Vec(1, 1, 0), Vec(-1, 1, 0), Vec(0.5, 0.2, gap)};
    for (Index n = 0; n < 5; ++n) nodes.x.set(n, x[n]), nodes.m[n] = 1, nodes.id[n] = n + 1;
    world.segments.fields.resize(1);
    shared_fields::eroded.add(world.segments.fields)[0] = 0;
    ContactFace face;
    face.node = {0, 1, 2, 3};
    const FaceCorners corners{x[0], x[1], x[2], x[3]};
    Tie tie{.node = 4, .segment = 0, .at = face_point(face, project(corners, 4, x[4]), gap)};
    tie.area = area, tie.k = k, tie.side = side;
    add_springs({.id = 7, .title = "", .strength = strength, .death = death}, {tie}, world);
    springs = world.passes.all<Force>().back();
  }
  void evaluate() {
    clock.t += 0.1, clock.dt = clock.dt_old = 0.1;
    world.nodes.f.fill(0);
    springs->start(world, clock);
    springs->block(world, clock, 0, 5);
  }
  /// Force on the node where it is this far from where it was tied.
  Vec at(const Vec& away) {
    world.nodes.x.set(4, Vec(0.5, 0.2, gap) + away);
    evaluate();
    return world.nodes.f.vec(4);
  }
  EnergyLedger ledger() const {
    EnergyLedger out;
    dynamic_cast<const EnergyTerm&>(*springs).sample(world, clock, out);
    return out;
  }
  Real lost() {
    EnergyLedger out;
    dynamic_cast<EnergyTerm&>(*springs).record(world, clock, out);
    return out.dissipated;
  }
  InterfaceForce report() const { return dynamic_cast<const InterfaceReporter&>(*springs).report(); }
};

}  // namespace

// -k times how far the node is from its position on the face, with the opposite on the corners: no force and
// no moment is left, whatever the gap; k/2 of the square is stored.
TEST(TiedTerms, SpringsAreInBalanceAndStoreTheirEnergy) {
  TiedScene s{TieStrength()};
  const Vec away(0.02, -0.01, 0.03);
  EXPECT_NEAR((s.at(away) + k * away).norm(), 0, 1e-13);
  Vec force = Vec::Zero(), moment = Vec::Zero();
  for (Index n = 0; n < 5; ++n) {
    const Vec f = s.world.nodes.f.vec(n);
    force += f, moment += s.world.nodes.x.vec(n).cross(f);
  }
  // the force is along what lies between both ends, so that its moment is none but for that
  EXPECT_NEAR(force.norm(), 0, 1e-13);
  EXPECT_NEAR(moment.norm(), 0, 1e-13);
  EXPECT_NEAR(s.ledger().contact, 0.5 * k * away.squaredNorm(), 1e-14);
  EXPECT_NEAR(s.report().energy_stored, 0.5 * k * away.squaredNorm(), 1e-14);
  EXPECT_NEAR((s.report().on_surfa + k * away).norm(), 0, 1e-13);
}

// (F_n/(A S_n))^n + (F_t/(A S_t))^m = 1, each with its own strength; a node below the face of a shell is
// drawn off it by what presses the one above.
TEST(TiedTerms, EachDirectionBreaksAtItsOwnStrength) {
  struct Case {
    Vec along;
    Real side, limit;  ///< of the force
  };
  for (const bool stress : {true, false}) {
    const Real unit = stress ? area : 1, never = 1e9;
    for (const Case& one : {Case{Vec(0, 0, 1), 1, 4 * unit},
                            {Vec(0, 0, -1), 1, never},
                            {Vec(0, 0, -1), -1, 4 * unit},
                            {Vec(0, 0, 1), -1, never},
                            {Vec(1, 0, 0), 1, 2 * unit},
                            {Vec(0, -1, 0), -1, 2 * unit},
                            // (3 u)^3 / 64 + (4 u)^2 / 4 = 1 of a force 5 u: u = 0.4784...
                            {Vec(0.8, 0, 0.6), 1, 0}}) {
      TieStrength strength{.normal = 4, .shear = 2, .n = 3, .m = 2, .stress = stress};
      Real limit = one.limit;
      if (limit == 0) {
        Real low = 0, high = 1;
        for (int it = 0; it < 60; ++it) {
          const Real u = 0.5 * (low + high);
          (std::pow(3 * u / 4, 3) + std::pow(4 * u / 2, 2) < 1 ? low : high) = u;
        }
        limit = 5 * low * unit;
      }
      const Real below = limit > 1e8 ? 1 : 0.999 * limit / k;
      TiedScene s(strength, one.side);
      EXPECT_GT(s.at(below * one.along).norm(), 0) << one.along.transpose() << one.side;
      EXPECT_EQ(s.world.counters["broken_ties"], 0);
      if (limit > 1e8) continue;
      EXPECT_EQ(s.at(1.001 * limit / k * one.along), Vec::Zero()) << one.along.transpose() << one.side;
      EXPECT_EQ(s.world.counters["broken_ties"], 1);
      EXPECT_NEAR(s.lost() / (0.5 * limit * limit / k), 1, 3e-3) << "what it stored";
      EXPECT_NEAR(s.report().energy_damping / (0.5 * limit * limit / k), 1, 3e-3);
    }
  }
}

// Behind its strength F at c0 = F/k a spring falls straight to nothing at the opening. Back and forth it has
// the secant of the widest; in all it loses the area F opening/2, and at any time what is under the curve but
// for what it stores.
TEST(TiedTerms, DamageFollowsItsLawAndDoesNotHeal) {
  const Real F = 4 * area, c0 = F / k, none = 0.1;
  TiedScene s(TieStrength{.normal = 4, .shear = 4, .n = 2, .m = 2, .stress = true, .opening = none});
  const auto held = [&](Real c) { return F * (none - c) / (none - c0); };
  const Vec along = Vec::UnitX();
  Real lost = 0;
  EXPECT_NEAR(s.at(c0 * along).norm(), F, 1e-12);
  const auto expect = [&](Real c, Real widest) {
    const Real force = held(widest) * c / widest;
    EXPECT_NEAR((s.at(c * along) + force * along).norm(), 0, 1e-12) << c;
    lost += s.lost();
    EXPECT_NEAR(s.ledger().contact, 0.5 * force * c, 1e-14) << c;
    const Real under = 0.5 * F * c0 + 0.5 * (F + held(widest)) * (widest - c0);
    EXPECT_NEAR(lost, under - 0.5 * held(widest) * widest, 1e-13) << c;
    EXPECT_NEAR(s.report().energy_damping, lost, 1e-14);
  };
  expect(0.04, 0.04), expect(0.02, 0.04), expect(0.03, 0.04), expect(0.06, 0.06), expect(0.01, 0.06);
  EXPECT_EQ(s.at(0.11 * along), Vec::Zero());
  lost += s.lost();
  EXPECT_NEAR(lost, 0.5 * F * none, 1e-13);
  EXPECT_NEAR(s.report().energy_damping, lost, 1e-14);
  EXPECT_EQ(s.ledger().contact, 0);
}

// At their death, and with their face, springs lose what they store.
TEST(TiedTerms, SpringsEndWithTheirDeathAndTheirFace) {
  for (const bool deleted : {false, true}) {
    TiedScene s(TieStrength(), 1, deleted ? 1e20 : 0.15);
    const Vec away(0.02, 0, 0);
    s.at(away);
    EXPECT_EQ(s.lost(), 0);
    if (deleted) shared_fields::eroded.add(s.world.segments.fields)[0] = shared_fields::deleted;
    EXPECT_EQ(s.at(away), Vec::Zero()) << deleted;
    EXPECT_NEAR(s.lost(), 0.5 * k * away.squaredNorm(), 1e-14) << deleted;
    EXPECT_NEAR(s.report().energy_damping, 0.5 * k * away.squaredNorm(), 1e-14);
    EXPECT_EQ(s.ledger().contact, 0);
    EXPECT_EQ(s.at(away), Vec::Zero()) << deleted;
  }
}

// Of own faces that look along the normal a node has its part of the area, and the softer side the stiffness.
TEST(TiedTerms, TiesHaveTheSofterSideAndTheAreaOfTheNode) {
  Nodes nodes;
  nodes.fields.resize(5);
  const Vec x[5] = {Vec(-1, -1, 0), Vec(1, -1, 0), Vec(1, 1, 0), Vec(-1, 1, 0), Vec(0.5, 0.2, -0.1)};
  for (Index n = 0; n < 5; ++n) nodes.x.set(n, x[n]);
  TieFace face;
  face.node = {0, 1, 2, 3}, face.k = 10, face.area = 4;
  const Projection at = project({x[0], x[1], x[2], x[3]}, 4, x[4]);
  for (const bool two_sided : {false, true}) {
    face.two_sided = two_sided;
    TieNode node{.node = 4};
    EXPECT_NEAR(tie_at(node, face, at, nodes.x).area, 1, 1e-12) << "a share of the face";
    for (const Real own : {3.0, 30.0}) {
      node.own = {{Vec(0, 0, 0.8), 4, own}, {Vec(0, 0, -0.6), 3, 2 * own}, {Vec(5, 0, 0), 4, 0.1}};
      const Tie tie = tie_at(node, face, at, nodes.x);
      EXPECT_NEAR(tie.area, 0.2 + 0.2, 1e-12);
      EXPECT_NEAR(tie.k, 0.4 * std::min(10.0, own), 1e-12);
      EXPECT_EQ(tie.side, two_sided ? -1 : 1);
      EXPECT_NEAR(tie.at.gap, -0.1, 1e-12);
    }
  }
}

// A block on a finer one, whose nodes its face carries exactly, is driven by a force on the lower one: in the
// first step what the face does to the tied nodes is their mass times its acceleration.
TEST(TiedTerms, CarriedNodesReportTheForceThatMovesThem) {
  test::SolidDeck deck;
  deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
  deck.block(Vec(0.4, 0.4, 0.4), 1, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(0.2, 0.3, 1)); });
  deck.cards =
      "*SECTION_SOLID\n1,1\n*PART\nbelow\n1,1,1\n*PART\nabove\n2,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E6,0.0\n"
      "*CONTACT_TIED_NODES_TO_SURFACE_ID\n7,glue\n2,1,3,3\n\n\n*LOAD_NODE_SET\n1,1,1,50.0\n"
      "*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n";
  deck.node_set(1, [](const Vec& x) { return x[2] == 0 || (x[2] == 1 && std::abs(x[0] - 0.5) == 0.5); });
  auto s = simulation_of(deck.text(1));
  Vec reported = Vec::Zero(), expected = Vec::Zero();
  std::vector<Vec> before;
  Real mass = 0, dt = 0;
  s->step([&](World& world, const Clock& clock, const std::string&) {
    for (const auto* one : world.passes.all<const InterfaceReporter>()) reported += one->report().on_surfa;
    dt = clock.dt_mean();
  });
  const Nodes& nodes = s->world().nodes;
  for (Index n = 0; n < nodes.size(); ++n)
    if (nodes.follow[n] == 2) expected += nodes.m[n] / dt * nodes.v.vec(n), mass += nodes.m[n];
  ASSERT_NEAR(mass, 32, 1e-9);
  EXPECT_GT(expected[0], 1);
  EXPECT_NEAR(reported[0], expected[0], 1e-6 * expected[0]);
}

// A face that is driven carries a block: the block takes nothing of the velocities that are prescribed.
TEST(TiedTerms, DrivenFacesKeepTheirVelocity) {
  test::SolidDeck deck;
  deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
  deck.block(Vec(0.4, 0.4, 0.4), 1, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(0.2, 0.3, 1)); });
  deck.cards =
      "*SECTION_SOLID\n1,1\n*PART\nbelow\n1,1,1\n*PART\nabove\n2,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E6,0.0\n"
      "*CONTACT_TIED_NODES_TO_SURFACE_ID\n7,glue\n2,1,3,3\n\n\n*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,0,1\n"
      "*DEFINE_CURVE\n1\n0.0,1.0\n1.0,3.0\n";
  deck.node_set(1, [](const Vec& x) { return x[2] == 0 || (x[2] == 1 && std::abs(x[0] - 0.5) == 0.5); });
  auto s = simulation_of(deck.text(1));
  for (int k = 0; k < 5; ++k) {
    s->step(do_nothing);
    const Real t = s->clock().t - 0.5 * s->clock().dt_old;
    for (Index n = 0; n < 8; ++n) EXPECT_NEAR(s->world().nodes.v.data(0)[n], 1 + 2 * t, 1e-12) << n;
  }
}

// A shell whose edge is tied to a plate that turns: angles and rates of the tied nodes are those of the face,
// of the same step.
TEST(TiedTerms, TiedNodesTurnWithTheirFace) {
  test::ShellDeck deck;
  deck.plate(1, 1, 1, 1, 1);
  deck.plate(0.4, 0.4, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(0.3, 0.3, 0.01)); });
  deck.part(1, 0.1, "*MAT_ELASTIC\n1,1000.0,1.0E6,0.3\n");
  deck.cards +=
      "*PART\nupper\n2,1,1\n*CONTACT_TIED_SHELL_EDGE_TO_SURFACE_CONSTRAINED_OFFSET_ID\n7,glue\n2,1,3,3\n\n\n";
  auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  const FieldSet& fields = s->world().nodes.fields;
  Field<Real>& spin = *shared_fields::angular_velocity.find(fields);
  const Field<Real>* angle = shared_fields::rotation.find(fields);
  ASSERT_NE(angle, nullptr);
  for (Index n = 0; n < 4; ++n) spin.set(n, Vec(0.3 * static_cast<Real>(n), 1, -0.5));
  for (int step = 0; step < 3; ++step) s->step(do_nothing);
  int tied = 0;
  for (Index n = 4; n < 8; ++n) {
    if (s->world().nodes.follow[n] != 2) continue;
    ++tied;
    const Vec x = s->world().nodes.x.vec(n);
    const Real N[4] = {(1 - x[0]) * (1 - x[1]), x[0] * (1 - x[1]), (1 - x[0]) * x[1], x[0] * x[1]};
    Vec mean = Vec::Zero(), rate = Vec::Zero();
    for (Index e = 0; e < 4; ++e) mean += N[e] * angle->vec(e), rate += N[e] * spin.vec(e);
    EXPECT_NEAR((angle->vec(n) - mean).norm(), 0, 0.02 * mean.norm());
    EXPECT_NEAR((spin.vec(n) - rate).norm(), 0, 0.02 * rate.norm());
  }
  EXPECT_GT(tied, 0);
}

}  // namespace tied_terms_test
