// Each term of loads, drives, damping and supports, and the work that it does, by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "../../verification/bodies/joint_decks.hpp"
#include "../../verification/shells/shell_decks.hpp"
#include "loads/load_cards.hpp"
#include "loads/loads.hpp"
#include "loads/point_motion.hpp"
#include "loads/sensors/sensor_math.hpp"
#include "loads/sensors/sensors.hpp"
#include "loads/walls/wall_penalty.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

using namespace courant;

namespace load_terms_test {
namespace {

using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

const std::string elastic = "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E7,0.3\n";
const std::string constant = "*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n";
/// Steps of 1e-4, below what a cube of side 0.2 allows.
const std::string even_steps =
    "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,99\n*DEFINE_CURVE\n99\n0.0,1.0e-4\n9.0,1.0e-4\n";

/// A cube of side 0.2, of 8 kg, as one element, or as rigid body.
SolidDeck cube(const std::string& cards, bool rigid = false) {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 1, 1, 1, 1);
  deck.cards =
      rigid ? "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*MAT_RIGID\n1,1000.0,1.0E7,0.3\n0\n0\n" : elastic;
  deck.cards += even_steps + cards;
  deck.node_set(1, [](const Vec&) { return true; });
  return deck;
}
Vec momentum_of(const World& world) {
  Vec p = Vec::Zero();
  for (Index n = 0; n < world.nodes.size(); ++n) p += world.nodes.m[n] * world.nodes.v.vec(n);
  return p;
}
/// Nodes alone, of mass 2, with the fields of points.
struct NodesAlone {
  World world;
  Clock clock;
  Model model;
  explicit NodesAlone(Index n) {
    world.nodes.fields.resize(n);
    model.nodes.resize(static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i) {
      world.nodes.id[i] = 11 + i, world.nodes.m[i] = 2;
      model.nodes[static_cast<std::size_t>(i)].id = 11 + i;
    }
    clock.dt = 0.03, clock.dt_old = 0.01, clock.t = 1;
  }
  Points points() { return points_of(world.nodes); }
};

}  // namespace

// Of what follows its forces: force times the mean velocity of the step to come. Of what others move: the
// mean of the forces before and now times the velocity of the step that was.
TEST(LoadTerms, WorkOfForcesOnFreeAndOnCarriedNodes) {
  for (const Index follow : {0, 1}) {
    NodesAlone s(1);
    s.world.nodes.follow[0] = follow;
    const NodalLoad load{.direction = Vec(0.6, 0, 0.8),
                         .curve = {.id = 1, .abscissa = {0, 2}, .ordinate = {0, 10}},
                         .sf = 3,
                         .nodes = {0}};
    const auto pass = make_nodal_loads({load}, s.model, s.points(), s.world);
    pass->start(s.world, s.clock);
    pass->block(s.world, s.clock, 0, 1);
    const Vec f = 15 * Vec(0.6, 0, 0.8);
    EXPECT_NEAR((s.world.nodes.f.vec(0) - f).norm(), 0, 1e-12);
    s.world.nodes.v.set(0, Vec(1, 2, 3)), s.world.nodes.f.add(0, Vec(5, 0, 0));
    EnergyLedger ledger;
    dynamic_cast<EnergyTerm&>(*pass).record(s.world, s.clock, ledger);
    const Vec mean = 3 * 5 * 0.995 * Vec(0.6, 0, 0.8), middle = Vec(1, 2, 3) + 0.01 / 2 * (f + Vec(5, 0, 0));
    EXPECT_NEAR(ledger.external_work, follow != 0 ? mean.dot(Vec(1, 2, 3)) * 0.01 : f.dot(middle) * 0.02,
                1e-12);
  }
}

// A follower of unequal arms pushes with SF times the curve, whatever the size of the triangle.
TEST(LoadTerms, FollowersPushAlongTheUnitNormal) {
  NodesAlone s(3);
  const Vec x[3] = {Vec(0, 0, 0), Vec(3, 0, 0), Vec(1, 4, 2)};
  for (Index n = 0; n < 3; ++n) s.world.nodes.x.set(n, x[n]);
  NodalLoad load{
      .direction = {}, .curve = {.id = 1, .abscissa = {0, 9}, .ordinate = {2, 2}}, .sf = 3, .nodes = {0, 2}};
  load.follows = {0, 1, 2};
  const auto pass = make_nodal_loads({load}, s.model, s.points(), s.world);
  pass->start(s.world, s.clock);
  pass->block(s.world, s.clock, 0, 3);
  const Vec f = 6 * Vec(0, -2, 4).normalized();
  for (const Index n : {0, 2}) EXPECT_NEAR((s.world.nodes.f.vec(n) - f).norm(), 0, 1e-12);
  EXPECT_EQ(s.world.nodes.f.vec(1), Vec::Zero());
}

// D (m v + dt/2 f') of the velocity in the middle of the kick, with f' the force that is left: at any step
// all of the kinetic energy that is missing is heat. Constants of several cards add up, by part.
TEST(LoadTerms, DampingTakesWhatItBooksAtAnyStep) {
  for (const Real dt : {1e-3, 0.3}) {
    NodesAlone s(2);
    s.world.nodes.part[0] = 0, s.world.nodes.part[1] = 1;
    s.clock.dt = s.clock.dt_old = dt;
    for (Index n = 0; n < 2; ++n)
      s.world.nodes.v.set(n, Vec(1, -2, 3)), s.world.nodes.f.set(n, Vec(4, 0, -1));
    const auto pass = make_damping({{.curve = {}, .sf = 1.5, .scale = Vec(1, 0.5, 2)},
                                    {.curve = {}, .sf = 2, .scale = Vec(1, 1, 0), .parts = {0}}},
                                   s.points(), s.world);
    pass->start(s.world, s.clock);
    pass->block(s.world, s.clock, 0, 2);
    EnergyLedger ledger;
    dynamic_cast<EnergyTerm&>(*pass).record(s.world, s.clock, ledger);
    Real lost = 0;
    for (Index n = 0; n < 2; ++n) {
      const Vec D = n == 0 ? Vec(3.5, 2.75, 3) : Vec(1.5, 0.75, 3), v(1, -2, 3), f(4, 0, -1);
      Vec after;
      for (int k = 0; k < 3; ++k)
        after[k] = ((1 - 0.5 * D[k] * dt) * v[k] + f[k] * dt / 2) / (1 + 0.5 * D[k] * dt);
      const Vec got = v + dt / 2 * s.world.nodes.f.vec(n);
      EXPECT_NEAR((got - after).norm(), 0, 1e-12) << n;
      lost += f.dot(0.5 * (v + got)) * dt - (got.squaredNorm() - v.squaredNorm());
    }
    EXPECT_NEAR(ledger.dissipated, lost, 1e-12) << dt;
  }
}

// Kinetic energy at t^n is that of the half step before, and what forces do through the half step from there.
TEST(LoadTerms, HalfAStepIsExplained) {
  NodesAlone s(1);
  s.world.nodes.v.set(0, Vec(1, 2, 3)), s.world.nodes.f.set(0, Vec(40, 0, -10));
  EnergyLedger ledger;
  const auto kinetic = make_kinetic_energy(s.points());
  kinetic->sample(s.world, s.clock, ledger);
  const Vec now = Vec(1, 2, 3) + 0.5 * 0.01 / 2 * Vec(40, 0, -10);
  EXPECT_NEAR(ledger.kinetic, 14, 1e-12);
  EXPECT_NEAR(ledger.half_step, now.squaredNorm() - 14, 1e-12);
  EXPECT_NEAR(ledger.below, 0.125 * 1e-4 * 1700 / 2, 1e-12);
  const auto motion = make_point_motion(s.points());
  motion->block(s.world, s.clock, 0, 1);
  EXPECT_NEAR((s.world.nodes.v.vec(0) - Vec(1, 2, 3) - 0.02 / 2 * Vec(40, 0, -10)).norm(), 0, 1e-12);
  EXPECT_NEAR((s.world.nodes.x.vec(0) - 0.03 * s.world.nodes.v.vec(0)).norm(), 0, 1e-12);
}

// A cube whose nodes are all driven along x against a force: velocity by VAD 0, 1 and 2; the drive gives m a
// less the force, in each step, and its work is that times the mean velocity, reported and in the ledger.
TEST(LoadTerms, DrivesFollowTheirCurveAndBookTheirWork) {
  for (const int vad : {0, 1, 2}) {
    // velocity 2 t, acceleration 2, displacement 0.001 t
    const std::string curve = vad == 0   ? "0.0,0.0\n1.0,2.0\n"
                              : vad == 1 ? "0.0,2.0\n1.0,2.0\n"
                                         : "0.0,0.0\n1.0,0.001\n";
    auto s =
        simulation_of(cube(fmt::format("*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,{},8\n*DEFINE_CURVE\n8\n", vad) +
                           curve + "*LOAD_NODE_SET\n1,1,1,-5.0\n" + constant + "*DATABASE_BNDOUT\n1.0e-4\n")
                          .text(1));
    test::start_ledger(*s);
    Real work = 0, last_v = 0;
    for (int k = 0; k < 30; ++k) {
      Real force = 0, reported = 0, dt = 0;
      s->step([&](World& world, const Clock& clock, const std::string& controlled_by) {
        dt = clock.dt_mean(), last_v = world.nodes.v.data(0)[0];
        for (const BoundaryForce& one : s->sample(controlled_by).boundary_forces)
          force += one.force[0], reported += one.work;
      });
      const Real v = s->world().nodes.v.data(0)[0];
      EXPECT_NEAR(force, 8 * (v - last_v) / dt + 8 * 5, 1e-8) << vad;
      if (k > 0) EXPECT_NEAR(reported, work, 1e-9) << vad << " " << k;
      work += (8 * (v - last_v) + 8 * 5 * dt) * 0.5 * (last_v + v);
    }
    const Real t = s->clock().t - 0.5 * s->clock().dt_old;
    EXPECT_NEAR(last_v, vad == 2 ? 0.001 : 2 * (t - s->clock().dt), 1e-9) << vad;
  }
}

// What is driven round an axis is on its circle after each step, about a centre that is not the origin.
TEST(LoadTerms, DrivesRoundAnAxisStayOnTheirCircle) {
  SolidDeck deck = cube(
      "*BOUNDARY_PRESCRIBED_MOTION_SET\n1,9,0,8,1.0\n0.3,-0.1,0.0\n*DEFINE_CURVE\n8\n0.0,50.0\n9.0,50.0\n");
  auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  const Vec centre(0, 0.3, -0.1);
  const auto from_axis = [&](Index n) {
    Vec r = s->world().nodes.x.vec(n) - centre;
    r[0] = 0;
    return r;
  };
  const Vec first = from_axis(0), last = from_axis(7);
  for (int k = 0; k < 40; ++k) s->step(do_nothing);
  for (const auto& [n, before] : {std::pair(Index(0), first), {Index(7), last}}) {
    const Vec now = from_axis(n);
    EXPECT_NEAR(now.norm(), before.norm(), 1e-9);
    EXPECT_NEAR(std::atan2(before.cross(now)[0], before.dot(now)), 50 * s->clock().t, 1e-9);
  }
}

// A triangle has half of the area of the square, a warped quadrilateral half of the product of its diagonals;
// each set presses with its own load.
TEST(LoadTerms, PressureActsOnTheAreaOfItsFaces) {
  struct Case {
    std::string cards;
    Vec force;
  };
  const std::string sets = "*SET_SEGMENT\n1\n1,2,4,3\n*SET_SEGMENT\n2\n1,3,7,5\n";
  for (const Case& one : {Case{"*LOAD_SEGMENT\n1,100.0,0.0,1,2,4\n", Vec(0, 0, -2)},
                          {"*LOAD_SEGMENT\n1,100.0,0.0,1,2,4,1\n", Vec(0, 0, -2)},
                          {"*LOAD_SEGMENT\n1,100.0,0.0,1,2,4,3\n", Vec(0, 0, -4)},
                          {"*LOAD_SEGMENT_SET\n1,1,100.0\n2,1,300.0\n" + sets, Vec(-12, 0, -4)}}) {
    auto s = simulation_of(cube(one.cards + constant).text(1));
    test::start_ledger(*s);
    for (int k = 0; k < 4; ++k) s->step(do_nothing);
    const Vec p = momentum_of(s->world()), impulse = (s->clock().t - 0.5 * s->clock().dt_old) * one.force;
    EXPECT_NEAR((p.cwiseAbs() - impulse.cwiseAbs()).norm(), 0, 2e-3 * impulse.norm()) << one.cards;
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.05) << one.cards;
  }
  // of a face with corners at 0, (0.3, 0), (0.2, 0.2), (0, 0.2): half of the product of its diagonals
  SolidDeck askew;
  askew.block(Vec(0.2, 0.2, 0.2), 1, 1, 1, 1,
              [](const Vec& x) { return Vec(x[0] > 0.1 && x[1] < 0.1 ? 0.3 : x[0], x[1], x[2]); });
  askew.cards = elastic + even_steps + "*LOAD_SEGMENT\n1,100.0,0.0,1,2,4,3\n" + constant;
  auto odd = simulation_of(askew.text(1));
  for (int k = 0; k < 3; ++k) odd->step(do_nothing);
  const Real impulse = (odd->clock().t - 0.5 * odd->clock().dt_old) * 100 * 0.05;
  EXPECT_NEAR(std::abs(momentum_of(odd->world())[2]), impulse, 2e-3 * impulse);
  // a pressure that slows its block down does negative work
  auto s = simulation_of(
      cube("*LOAD_SEGMENT\n1,1000.0,0.0,1,2,4,3\n*INITIAL_VELOCITY\n1\n0.0,0.0,1.0\n" + constant).text(1));
  test::start_ledger(*s);
  const Real before = momentum_of(s->world())[2];
  for (int k = 0; k < 10; ++k) s->step(do_nothing);
  const Real change = momentum_of(s->world())[2] - before;
  EXPECT_NEAR(s->world().energy.external_work / change, 1, 0.02) << "force times shift is impulse times 1";
}

// A mirrored file: SF of shells changes its sign, faces of segments turn.
TEST(LoadTerms, MirrorsKeepTheSideThatIsPressed) {
  for (const bool mirrored : {false, true}) {
    Affine motion = Affine::Identity();
    if (mirrored) motion.linear()(1, 1) = -1;
    LoadShellFields shell;
    shell.sf = 3;
    EXPECT_EQ(keep_shell_side(shell, motion), "");
    EXPECT_EQ(shell.sf, mirrored ? -3 : 3);
    LoadSegment segment;
    segment.n1 = 1, segment.n2 = 2, segment.n3 = 3, segment.n4 = 4;
    EXPECT_EQ(keep_side(segment, motion), "");
    EXPECT_EQ(segment.n1, mirrored ? 3 : 1);
    EXPECT_EQ(segment.n3, mirrored ? 1 : 3);
  }
}

// Supports along x and y hold nothing along z: each code its own axis, and reactions along it.
TEST(LoadTerms, EachSpcHoldsItsOwnAxis) {
  for (int held = 0; held < 3; ++held) {
    NodesAlone s(1);
    s.model.nodes[0].fixed[static_cast<std::size_t>(held)] = true;
    s.world.nodes.v.set(0, Vec(1, 2, 3)), s.world.nodes.f.set(0, Vec(4, 5, 6));
    const auto pass = make_fixed_points(s.model, s.points(), s.world, true);
    pass->block(s.world, s.clock, 0, 1);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(s.world.nodes.v.data(k)[0], k == held ? 0 : k + 1);
      EXPECT_EQ(s.world.nodes.f.data(k)[0], k == held ? 0 : k + 4);
    }
    std::vector<BoundaryForce> out;
    dynamic_cast<BoundaryForceReporter&>(*pass).report_forces(s.world, s.clock, out);
    EXPECT_EQ(out.at(0).force, Vec(-(held + 4.0) * Vec::Unit(held)));
  }
}

// A node that a support holds along two oblique axes moves along the third alone; the reactions of all carry
// the weight along the held ones.
TEST(LoadTerms, ObliqueSupportsLeaveOneDirection) {
  const Matrix turn = Eigen::AngleAxisd(0.6, Vec(1, 2, 2).normalized()).toRotationMatrix();
  const Vec a = turn.col(0), b = turn.col(1), free = turn.col(2);
  auto s = simulation_of(
      cube(fmt::format("*DEFINE_COORDINATE_VECTOR\n7,{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}\n", a[0], a[1],
                       a[2], b[0], b[1], b[2]) +
           "*BOUNDARY_SPC_SET\n1,7,1,1,0\n*LOAD_BODY_Z\n1,9.81\n*DATABASE_SPCFORC\n1.0e-4\n" + constant)
          .text(1));
  Vec sum = Vec::Zero();
  for (int k = 0; k < 5; ++k) {
    sum.setZero();
    s->step([&](World&, const Clock&, const std::string& controlled_by) {
      for (const BoundaryForce& one : s->sample(controlled_by).boundary_forces) sum += one.force;
    });
  }
  const Vec weight(0, 0, -8 * 9.81);
  EXPECT_NEAR((sum + weight - weight.dot(free) * free).norm(), 0, 1e-6);
  const Vec v = s->world().nodes.v.vec(0);
  EXPECT_GT(v.norm(), 1e-3);
  EXPECT_NEAR((v - v.dot(free) * free).norm(), 0, 1e-9);
}

// Two systems whose x axes are 60 degrees apart: what is held by both leaves the direction across both.
TEST(LoadTerms, ObliqueSupportsOfTwoSystems) {
  const Vec a = Vec(1, 2, 2) / 3, b = (0.5 * a + std::sqrt(0.75) * Vec(2, 1, -2) / 3).normalized();
  const Vec free = a.cross(b).normalized();
  const auto system = [&](int id, const Vec& x) {
    const Vec y = free.cross(x);
    return fmt::format("*DEFINE_COORDINATE_VECTOR\n{},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}\n", id, x[0],
                       x[1], x[2], y[0], y[1], y[2]);
  };
  auto s = simulation_of(cube(system(7, a) + system(8, b) +
                              "*BOUNDARY_SPC_SET\n1,7,1,0,0\n1,8,1,0,0\n*LOAD_BODY_Z\n1,9.81\n" + constant)
                             .text(1));
  for (int k = 0; k < 5; ++k) s->step(do_nothing);
  const Vec v = s->world().nodes.v.vec(0);
  EXPECT_GT(v.norm(), 1e-4);
  EXPECT_NEAR((v - v.dot(free) * free).norm(), 0, 1e-9);
}

// Each node of a set must be one on which forces act, not its first one alone.
TEST(LoadTerms, AllNodesOfALoadAreLookedUp) {
  SolidDeck deck = cube("*LOAD_NODE_SET\n5,1,1,1.0\n" + constant + "*SET_NODE_LIST\n5\n1,2,9\n");
  deck.nodes.push_back(Vec(9, 9, 9));
  Diagnostics diagnostics;
  ReadOptions options;
  const std::string text = deck.text(1);
  options.open = [text](const std::string&) { return text; };
  EXPECT_EQ(Simulation::build("test.k", options, diagnostics), nullptr);
  EXPECT_NE(diagnostics.text().find("node 9 is neither a particle"), std::string::npos) << diagnostics.text();
}

// Nodes of a set share the acceleration of their sum, up to TF.
TEST(LoadTerms, NodeSetsShareTheAccelerationOfTheirSum) {
  SolidDeck deck = cube("*CONSTRAINED_NODE_SET\n2,1,0.00105\n*LOAD_NODE_POINT\n1,1,1,8.0\n" + constant);
  deck.node_set(2, [](const Vec& x) { return x[0] < 0.1; });
  auto s = simulation_of(deck.text(1));
  for (int k = 0; k < 2; ++k) s->step(do_nothing);
  const World& world = s->world();
  // four nodes of 1 kg each; elements push back by less than 1e-3 of that in two steps
  const Real t = s->clock().t - 0.5 * s->clock().dt_old;
  for (const Index n : {0, 2, 4, 6}) EXPECT_NEAR(world.nodes.v.data(0)[n], 2 * t, 5e-2 * 2 * t) << n;
  EXPECT_EQ(world.nodes.v.data(0)[0], world.nodes.v.data(0)[6]);
  while (s->clock().t < 0.003) s->step(do_nothing);
  EXPECT_NE(world.nodes.v.data(0)[0], world.nodes.v.data(0)[6]);
}

// FLAG 1 of *DAMPING_PART_MASS has scales of the axes; without it they are 1, whatever is given there.
TEST(LoadTerms, ScalesOfDampingCountWithTheirFlag) {
  for (const int flag : {0, 1}) {
    auto s = simulation_of(cube(fmt::format("*DAMPING_PART_MASS\n1,1,100.0,{}\n", flag) +
                                (flag == 1 ? "1.0,0.0,0.5\n" : "") + "*INITIAL_VELOCITY\n1\n1.0,1.0,1.0\n" +
                                constant)
                               .text(1));
    while (s->clock().t < 0.005) s->step(do_nothing);
    const Real t = s->clock().t - 0.5 * s->clock().dt_old;
    const Vec v = momentum_of(s->world()) / 8;
    EXPECT_NEAR(v[0], std::exp(-100 * t), 2e-3);
    EXPECT_NEAR(v[1], flag == 1 ? 1 : std::exp(-100 * t), 2e-3);
    EXPECT_NEAR(v[2], std::exp(-(flag == 1 ? 50 : 100) * t), 2e-3);
  }
}

// Weight of parts, a turning frame and a ramp: what changes is work, in each step, of the whole change.
TEST(LoadTerms, LoadsThatChangeDoTheirWork) {
  for (const bool rigid : {false, true})
    for (const std::string load :
         {"*LOAD_BODY_X\n8\n", "*LOAD_BODY_RZ\n8,1.0,0,1.0,2.0,0.0\n", "*LOAD_GRAVITY_PART\n1,1,8,1.0\n"}) {
      auto s = simulation_of(cube(load + "*DEFINE_CURVE\n8\n0.0,2.0\n0.1,40.0\n", rigid).text(1));
      test::start_ledger(*s);
      Real worst = 0, most = 0;
      while (s->clock().t < 0.05)
        s->step([&](World& world, const Clock& clock, const std::string&) {
          sample_energy(world, clock);
          worst = std::max(worst, std::abs(world.energy.unexplained()));
          most = std::max(most, world.energy.kinetic);
        });
      EXPECT_GT(most, 1e-3) << load << rigid;
      EXPECT_LT(worst, 0.02 * most) << load << rigid;
    }
}

// Distances between two nodes, their largest and least, means and sums, along a direction or in all.
TEST(LoadTerms, SensorsMeasureByTheirNodes) {
  NodesAlone s(3);
  const Vec x[3] = {Vec(1, 2, 3), Vec(4, -2, 8), Vec(0, 1, -7)};
  for (Index n = 0; n < 3; ++n) s.world.nodes.x.set(n, x[n]), s.world.nodes.v.set(n, 2 * x[n]);
  using Of = NodeSensor::Of;
  NodeSensor sensor;
  sensor.nodes = {1}, sensor.base = {0}, sensor.velocity = false;
  EXPECT_NEAR(sensor.value(s.world), (x[1] - x[0]).norm(), 1e-12);
  sensor.direction = Vec::UnitY();
  EXPECT_NEAR(sensor.value(s.world), -4, 1e-12);
  sensor.velocity = true;
  EXPECT_NEAR(sensor.value(s.world), -8, 1e-12);
  sensor.base = {}, sensor.nodes = {0, 1, 2};
  for (const auto& [of, value] : {std::pair(Of::largest, 4.0), {Of::least, -4.0}, {Of::mean, 2.0 / 3}}) {
    sensor.of = of;
    EXPECT_NEAR(sensor.value(s.world), value, 1e-12);
  }
}
TEST(LoadTerms, CalculationsOfSensors) {
  const std::vector<Real> v{3, -4, 2};
  for (const auto& [name, value] : {std::pair("SUM", 1.0),
                                    {"ABSSUM", 1.0},
                                    {"SUMABS", 9.0},
                                    {"MAX", 3.0},
                                    {"MIN", -4.0},
                                    {"MAXMAG", 4.0},
                                    {"MINMAG", 2.0},
                                    {"MULTIPLY", -24.0},
                                    {"SQRE", 29.0},
                                    {"SQRTSQRE", std::sqrt(29.0)}})
    EXPECT_NEAR(sensor_math(name)(v), value, 1e-12) << name;
  EXPECT_NEAR(sensor_math("ABSSUM")({-3, 1}), 2, 1e-12);
  EXPECT_NEAR(sensor_math("SQRT")({4, 9}), 5, 1e-12);
}

// Springs between a wall and a body of mass m: s/(trace dt^2) of their stiffness, 3/m a node that is one
// body.
TEST(LoadTerms, WallsPushBodiesByTheirScale) {
  NodesAlone s(1);
  WallBodies bodies;
  bodies.of_node = {0};
  bodies.answer_alone = [](Index, const Vec&, const Vec& impulse, const Vec&) { return Vec(impulse / 2); };
  bodies.give = [](Index, const Vec&, const Vec&) { return 0.5; };
  bodies.change = [](Index, const Vec&, const Clock&) { return Vec(0.02, 0, 0); };
  Vec pushed = Vec::Zero();
  bodies.push = [&](Index, const Vec&, const Vec& force) { pushed += force; };
  WallPenalty penalty({{0, 0}}, bodies, 0.5);
  WallShape floor;
  floor.axes << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // n = y
  floor.axes.col(2) = Vec::UnitY(), floor.axes.col(0) = Vec::UnitX(), floor.axes.col(1) = -Vec::UnitZ();
  s.world.nodes.x.set(0, Vec(0, 0.1, 0)), s.world.nodes.v.set(0, Vec(1, -1, 0));
  WallPenalty::Wall wall{.shape = &floor, .moved = Vec::Zero(), .v = Vec(0.4, 0, 0)};
  wall.friction = [](const Vec&, const Vec& slip, Real push, Real, Real) {
    return Vec(-0.3 * push * slip.normalized());
  };
  penalty.push(s.world, s.clock, wall);
  EXPECT_EQ(pushed, Vec::Zero());
  s.world.nodes.x.set(0, Vec(0, -0.01, 0));
  penalty.push(s.world, s.clock, wall);
  const Real F = 0.5 / (1.5 * 0.03 * 0.03) * 0.01;
  EXPECT_NEAR((pushed - Vec(-0.3 * F, F, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((penalty.force() + pushed).norm(), 0, 1e-12);
  EXPECT_NEAR(penalty.normal(), F, 1e-12);
  EXPECT_NEAR(penalty.stored(), 0.5 * F * 0.01, 1e-12);
  EXPECT_NEAR(penalty.friction_loss(s.world, s.clock, Vec(0.4, 0, 0)), 0.3 * F * (1 + 0.01 - 0.4) * 0.02,
              1e-12);
  EXPECT_NEAR(penalty.release(), 0.5 * F * 0.01, 1e-12);
  EXPECT_EQ(penalty.force(), Vec::Zero());
}

// The nearest position of each shape, and which points a plane with edges meets.
TEST(LoadTerms, PlanesWithEdgesMeetWhatIsOverThem) {
  WallShape plane;
  plane.tail = Vec(1, 2, 3), plane.length = {2, 0.5, 0};
  for (const auto& [x, y, meets] : {std::tuple(1.0, 0.2, true),
                                    {2.1, 0.2, false},
                                    {-0.1, 0.2, false},
                                    {1.0, 0.6, false},
                                    {1.0, -0.1, false}})
    EXPECT_EQ(plane.meets(Vec(1, 2, 3) + Vec(x, y, -0.1), 0.1), meets) << x << " " << y;
  EXPECT_FALSE(plane.meets(Vec(2, 2.2, 2.9), -0.1)) << "it came behind it beside an edge";
  plane.length = {2, 0, 0};
  EXPECT_TRUE(plane.meets(Vec(2, 50, 2.9), 0.1));
}

// With a switch that holds since t0, WINDOW and DELAY later it is on; where it does not hold it begins again.
TEST(LoadTerms, SwitchesWaitForWindowAndDelay) {
  Real measured = 0;
  SensorSwitch s;
  s.sensor = 0, s.greater = true, s.value = 1, s.window = 0.3, s.delay = 0.2;
  Sensor sensor;
  sensor.value = [&](const World&, const Clock&) { return measured; };
  SensorControl control;
  control.on_first = false, control.switches = {0};
  SensorBoard board({sensor}, {s}, {control});
  World world;
  Clock clock;
  const auto at = [&](Real t, Real value) {
    clock.t = t, ++clock.cycle, measured = value;
    board.strike(world, clock);
    return board.control_is_on(0);
  };
  EXPECT_FALSE(at(0, 0));
  EXPECT_FALSE(at(1, 2));
  EXPECT_FALSE(at(1.29, 2));
  EXPECT_FALSE(at(1.45, 2)) << "the window alone";
  EXPECT_FALSE(at(1.46, 0)) << "it begins again";
  EXPECT_FALSE(at(2, 2));
  EXPECT_FALSE(at(2.49, 2));
  EXPECT_TRUE(at(2.51, 2));
}

}  // namespace load_terms_test
