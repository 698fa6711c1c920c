// Cards of loads and drives one by one: each direction, system, sign, window and unit, on nodes at their
// start.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../../verification/shells/shell_decks.hpp"
#include "../../verification/structures/solid_decks.hpp"
#include "loads/blast/blast_wave.hpp"
#include "loads/program_forces.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

using namespace courant;

namespace load_cards_test {
namespace {

using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;
using test::SolidDeck;

/// So heavy and so soft that nothing moves: what is on the nodes are the loads alone.
const std::string heavy = "*MAT_ELASTIC\n1,1.0E7,1.0E-3,0.3\n";
/// x' = y, y' = z, z' = x.
const std::string system_7 = "*DEFINE_COORDINATE_SYSTEM\n7,0.0,0.0,0.0,0.0,1.0,0.0\n0.0,0.0,1.0\n";

/// Two shells of 0.3 x 0.2 along x in z = 0, of nodes 1 2 3 / 4 5 6, and a set of nodes 2 and 5.
ShellDeck plate(const std::string& cards, Real step = 0.01) {
  ShellDeck deck;
  deck.plate(0.6, 0.2, 2, 1, 1);
  deck.part(1, 0.1, heavy);
  deck.cards +=
      fmt::format("*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,99\n*DEFINE_CURVE\n99\n0.0,{0}\n99.0,{0}\n", step) +
      cards;
  deck.node_set(1, [](const Vec& x) { return std::abs(x[0] - 0.3) < 0.01; });
  return deck;
}
/// Sum over the nodes, and the nodes that have any.
struct Total {
  Vec sum = Vec::Zero();
  std::vector<Id> on;
};
Total total(const World& world, const Field<Real>& field) {
  Total out;
  for (Index n = 0; n < world.nodes.size(); ++n) {
    out.sum += field.vec(n);
    if (field.vec(n).norm() > 1e-12) out.on.push_back(world.nodes.id[n]);
  }
  return out;
}
/// At the start of the step from about `time`.
Vec force_at(Simulation& s, Real time) {
  Vec out = Vec::Zero();
  for (Real t = -1; t < time - 1e-9;)
    s.step([&](World& world, const Clock& clock, const std::string&) {
      t = clock.t, out = total(world, world.nodes.f).sum;
    });
  return out;
}
Vec along(int axis, bool of_system) {
  return Vec::Unit(of_system ? (axis + 1) % 3 : axis);
}

}  // namespace

// 5 from the curve, times SF, on each node of the set: forces, moments, along axes, those of a system, and
// the normal of three nodes.
TEST(LoadCards, NodalLoadsHaveTheirDirection) {
  for (const int dof : {1, 2, 3, 4, 5, 6, 7, 8})
    for (const bool set : {false, true})
      for (const bool of_system : {false, true}) {
        const bool follows = dof % 4 == 0;
        if (follows && of_system) continue;
        auto s = simulation_of(plate((set ? "*LOAD_NODE_SET\n1," : "*LOAD_NODE_POINT\n2,") +
                                     fmt::format("{},8,3.0,{}", dof, of_system ? 7 : 0) +
                                     (follows ? ",1,4,2\n" : "\n") + "*DEFINE_CURVE\n8\n0.0,5.0\n9.0,5.0\n" +
                                     system_7)
                                   .text(1));
        ASSERT_NE(s, nullptr);
        test::start_ledger(*s);
        const Total force = total(s->world(), s->world().nodes.f),
                    moment = total(s->world(), *shared_fields::moment.find(s->world().nodes.fields));
        const Vec direction = follows ? Vec(0, 0, -1) : along((dof - 1) % 4, of_system);
        const Vec expected = 15 * (set ? 2 : 1) * direction;
        EXPECT_NEAR(((dof > 4 ? moment : force).sum - expected).norm(), 0, 1e-9) << dof << set << of_system;
        EXPECT_NEAR((dof > 4 ? force : moment).sum.norm(), 0, 1e-9) << dof;
        EXPECT_EQ((dof > 4 ? moment : force).on, set ? (std::vector<Id>{2, 5}) : (std::vector<Id>{2})) << dof;
      }
}

// Against the normal of a shell, with SF, and from AT on, where the curve begins.
TEST(LoadCards, PressureOnShellsBeginsAtItsTime) {
  const std::string curve = "*DEFINE_CURVE\n8\n0.0,5.0\n1.0,105.0\n", set = "*SET_SHELL_LIST\n4\n1,2\n";
  struct Case {
    std::string cards;
    Real area;
  };
  for (const Case& one : {Case{"*LOAD_SHELL_ELEMENT\n2,8,-3.0,0.05\n", 0.06},
                          {"*LOAD_SHELL_SET\n4,8,-3.0,0.05\n", 0.12},
                          {"*LOAD_SEGMENT\n8,-3.0,0.05,1,2,5,4\n", 0.06},
                          {"*SET_SEGMENT\n3\n1,2,5,4\n2,3,6,6\n*LOAD_SEGMENT_SET\n3,8,-3.0,0.05\n", 0.09}}) {
    auto s = simulation_of(plate(one.cards + curve + set).text(1));
    ASSERT_NE(s, nullptr);
    EXPECT_EQ(force_at(*s, 0.04), Vec::Zero()) << "before AT";
    EXPECT_NEAR((force_at(*s, 0.09) - Vec(0, 0, 3 * 9 * one.area)).norm(), 0, 1e-6) << one.cards;
  }
}

// On nodes: velocity, acceleration and displacement along each axis and a vector, SF, BIRTH and DEATH; other
// axes and nodes stay as they are; the field of driven axes says so.
TEST(LoadCards, DrivesOfNodesMoveTheirDegreeOfFreedomInTheirTime) {
  for (const int dof : {1, 2, 3, 4, 5, 6, 7})
    for (const int vad : {0, 1, 2}) {
      auto s = simulation_of(
          plate(fmt::format("*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,{},{},8,2.0,{},0.1,0.04\n", dof, vad,
                            dof == 4 ? 3 : 0) +
                "*DEFINE_VECTOR\n3,0.1,0.2,0.3,0.1,3.2,4.3\n*DEFINE_CURVE\n8\n" +
                (vad == 1 ? "0.0,0.5\n9.0,0.5\n" : "0.0,0.0\n1.0,0.4\n") + "*DATABASE_BNDOUT\n0.001\n")
              .text(1));
      ASSERT_NE(s, nullptr);
      World& world = s->world();
      const bool turns = dof > 4;
      Field<Real>& v = turns ? *shared_fields::angular_velocity.find(world.nodes.fields) : world.nodes.v;
      const Vec d = dof == 4 ? Vec(0, 0.6, 0.8) : along((dof - 1) % 4, false);
      const Index node = 1;
      EXPECT_EQ(world.nodes.id[node], 2);
      for (int k = 0; k < 14; ++k) {
        const Real t = s->clock().t, before = v.vec(node).dot(d), since = t - 0.04;
        std::vector<BoundaryForce> forces;
        s->step([&](World&, const Clock&, const std::string& controlled_by) {
          forces = s->sample(controlled_by).boundary_forces;
        });
        const Real now = v.vec(node).dot(d), drives = t > 0.035 && t < 0.095;
        const Real expected = !drives    ? before
                              : vad == 0 ? 2 * 0.4 * (since + 0.005)
                              : vad == 1 ? before + 2 * 0.5 * (since < 0.005 ? 0.005 : 0.01)
                                         : 2 * 0.4;
        EXPECT_NEAR(now, expected, 1e-7) << dof << vad << " " << t;
        EXPECT_NEAR((v.vec(node) - now * d).norm(), 0, 1e-7) << dof << vad << " across";
        EXPECT_NEAR(total(world, v).sum.norm(), std::abs(now), 1e-6) << "no other node moves";
        if (!turns)
          EXPECT_EQ(shared_fields::driven_axes.find(world.nodes.fields)->data()[node], !drives ? 0
                                                                                       : dof == 4
                                                                                           ? 6
                                                                                           : 1 << (dof - 1))
              << dof << " at " << t;
        ASSERT_EQ(forces.size(), 1u);
        const Real inertia = turns ? shared_fields::rotary_inertia.find(world.nodes.fields)->data()[node]
                                   : world.nodes.m[node];
        EXPECT_EQ(forces[0].id, 2);
        EXPECT_EQ(forces[0].kind,
                  turns ? BoundaryForce::Kind::driven_rotation : BoundaryForce::Kind::driven_point);
        const Real dt = k == 0 ? 0.005 : 0.01;
        EXPECT_NEAR((turns ? forces[0].moment : forces[0].force).dot(d) / inertia,
                    drives ? (now - before) / dt : 0, 1e-5)
            << dof << vad << " " << t;
      }
      EXPECT_GT(std::abs(v.vec(node).dot(d)), 0.01) << "it has driven";
    }
}

// 8 kg of TNT 2 m above plates that lie aslant to it, in each system of units that has a number: the pressure
// of a step is the mean of the wave from half a step before to half a step behind, on the middle of each
// face, under the angle from there to the charge. Plates are so heavy that they do not move.
TEST(LoadCards, BlastsInAllUnits) {
  struct Units {
    int number;
    Real kilograms, metres, seconds, pascals;  ///< of one unit
  };
  constexpr Real pound = 0.45359237, foot = 0.3048, psi = 6894.757293168361, slug = 14.59390293720636;
  for (const Units& u : {Units{1, pound, foot, 1, psi},
                         {2, 1, 1, 1, 1},
                         {3, 12 * slug, foot / 12, 1, psi},
                         {4, 1e-3, 1e-2, 1e-6, 1e11},
                         {5, 3, 0.5, 0.01, 7e4},
                         {6, 1, 1e-3, 1e-3, 1e9},
                         {7, 1e3, 1e-3, 1, 1e6},
                         {8, 1e-3, 1e-3, 1e-3, 1e6}}) {
    ShellDeck deck;
    deck.plate(3 / u.metres, 1 / u.metres, 1, 1, 1);
    deck.part(1, 0.1 / u.metres, "*MAT_ELASTIC\n1,1.0E12,1.0,0.3\n");
    const Real step = 2e-4 / u.seconds;
    deck.cards += fmt::format(
        "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,99\n*DEFINE_CURVE\n99\n0.0,{0:.9e}\n1.0e9,{0:.9e}\n"
        "*LOAD_BLAST_ENHANCED\n5,{1:.9e},{2:.9e},{3:.9e},{4:.9e},{5:.9e},{6},2\n"
        "{7:.9e},{8:.9e},{9:.9e},{10:.9e},0,{11:.9e},1\n*LOAD_BLAST_SEGMENT\n5,1,2,4,3,0,0.0,1.5\n",
        step, 8 / u.kilograms, 2.5 / u.metres, 1 / u.metres, 2 / u.metres, 1e-3 / u.seconds, u.number,
        u.number == 5 ? u.kilograms / pound : 0, u.number == 5 ? u.metres / foot : 0,
        u.number == 5 ? 1e3 * u.seconds : 0, u.number == 5 ? u.pascals / psi : 0, 9.1e-3 / u.seconds);
    auto s = simulation_of(deck.text(1e9 * step));
    ASSERT_NE(s, nullptr) << u.number;
    const Vec to_charge(1, 0.5, 2);  // from the middle of the face [m]
    const BlastWave wave = blast_wave(BlastKind::air, 8 / pound, to_charge.norm() / foot);
    const Real cosine = to_charge[2] / to_charge.norm();
    Real peak = 0, behind = 1;
    for (int k = 0; k < 60; ++k)
      s->step([&](World& world, const Clock& clock, const std::string&) {
        const Real t = 0.2 * k - 1, half = k == 0 ? 0 : 0.1;  // ms since the detonation
        const Real mean =
            k == 0
                ? 0
                : (wave.impulse(t + half, cosine, true) - wave.impulse(t - half, cosine, true)) / (2 * half);
        EXPECT_NEAR(clock.t * u.seconds, 1e-3 * 0.2 * k, 1e-9);
        const Vec force = total(world, world.nodes.f).sum;
        const bool is_over = 0.2 * k > 9.1;  // DEATH
        // of 4.5e6 N: nine digits of the deck
        EXPECT_NEAR(force[2] * u.pascals * u.metres * u.metres, is_over ? 0 : -3 * 1.5 * mean * psi, 1)
            << u.number << " " << k;
        peak = std::max(peak, mean);
        if (is_over) behind = force.norm();
      });
    EXPECT_GT(peak, 30) << "the wave has passed [psi]";
    EXPECT_EQ(behind, 0);
  }
}

// rho c A v at each node: c_p along the normal where AD is 0, c_s across where AS is 0, a quarter of the face
// or a third of a triangle for each corner; f' = (f - C v)/(1 + dt C/2m).
TEST(LoadCards, BoundariesTakeWavesByTheirDirection) {
  const Real young = 2e6, nu = 0.3, rho = 1000, side = 0.2;
  const Real lambda = young * nu / ((1 + nu) * (1 - 2 * nu)), shear = young / (2 * (1 + nu));
  const Real fast = std::sqrt((lambda + 2 * shear) / rho), slow = std::sqrt(shear / rho);
  for (const bool ad : {false, true})
    for (const bool as : {false, true})
      for (const int axis : {0, 2}) {
        SolidDeck deck;
        deck.block(Vec(side, side, side), 1, 1, 1, 1);
        deck.cards = fmt::format(
            "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1000.0,2.0E6,0.3\n*SET_SEGMENT\n1\n"
            "{}\n*BOUNDARY_NON_REFLECTING\n1,{},{}\n",
            axis == 2 ? "5,6,8,7" : "2,4,8,6", ad ? 1 : 0, as ? 1 : 0);
        auto s = simulation_of(deck.text(1));
        ASSERT_NE(s, nullptr);
        World& world = s->world();
        const Vec v(0.3, 0.4, 0.5);
        for (Index n = 0; n < world.nodes.size(); ++n) world.nodes.v.set(n, v);
        test::start_ledger(*s);
        Vec expected = Vec::Zero();
        for (int k = 0; k < 3; ++k)
          expected[k] = -rho * side * side * (k == axis ? (ad ? 0 : fast) : (as ? 0 : slow)) * v[k];
        // without a step before this one there is nothing implicit
        EXPECT_NEAR((total(world, world.nodes.f).sum - expected).norm(), 0, 1e-9) << ad << as << axis;
        for (Index n = 0; n < world.nodes.size(); ++n) {
          const bool on = world.nodes.x.vec(n)[axis] > 0.1;
          EXPECT_NEAR((world.nodes.f.vec(n) - (on ? 0.25 : 0) * expected).norm(), 0, 1e-9) << n;
        }
      }
}

// Forces of a program act from the next step until they change, velocities at once; held axes keep theirs,
// and both are work from outside.
TEST(LoadCards, ProgramsPushAndMoveNodes) {
  auto s =
      simulation_of(plate("*COURANT_PROGRAM_FORCES\n1\n*BOUNDARY_SPC_NODE\n2,0,0,1,0\n"
                          "*BOUNDARY_PRESCRIBED_MOTION_NODE\n3,1,0,8\n*DEFINE_CURVE\n8\n0.0,0.0\n9.0,0.0\n")
                        .text(1));
  ASSERT_NE(s, nullptr);
  test::start_ledger(*s);
  World& world = s->world();
  auto& changes = *s->get<ProgramForces>().on_nodes;
  s->step(do_nothing);
  const Real m = world.nodes.m[1];
  changes.set_force(1, m * Vec(4, 5, 6));
  EXPECT_EQ(world.energy.external_work, 0);
  for (int k = 0; k < 5; ++k) s->step(do_nothing);
  EXPECT_NEAR((world.nodes.v.vec(1) - 0.05 * Vec(4, 0, 6)).norm(), 0, 1e-7) << "y is held";
  EXPECT_NEAR(world.energy.external_work, 0.5 * m * 0.0025 * (16 + 36), 1e-5 * m);
  changes.set_force(1, Vec::Zero());
  const Real work = world.energy.external_work, passed = world.energy.throughput;
  EXPECT_EQ(changes.set_velocity(world, 1, Vec(0.1, 7, 0.2)), "");
  EXPECT_EQ(world.nodes.v.vec(1), Vec(0.1, 0, 0.2));
  s->step(do_nothing);
  EXPECT_NEAR((world.nodes.v.vec(1) - Vec(0.1, 0, 0.2)).norm(), 0, 1e-7) << "no force is left";
  const Real gained = 0.5 * m * (0.05 - 0.0025 * (16 + 36));
  EXPECT_LT(gained, 0);
  EXPECT_NEAR(world.energy.external_work - work, gained, 1e-5 * m);
  EXPECT_NEAR(world.energy.throughput - passed, -gained, 1e-5 * m);
  EXPECT_EQ(changes.why_not(world, 1), "");
  EXPECT_NE(changes.set_velocity(world, 2, Vec(1, 2, 3)), "") << "its motion is prescribed";
}

}  // namespace load_cards_test
