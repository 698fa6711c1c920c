// Ghost particles behind planes against the same flow computed whole.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "../app/small_scene.hpp"
#include "base/run_error.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

struct State {
  Vec x, v;
  Real rho, p;
};
using States = std::map<Id, State>;

/// A deck of 2D water of viscosity MU on a lattice of nx x ny with spacing 0.1, the lowest corner at
/// (left, low); particle ids count from the left lower corner of a larger lattice of `columns` columns.
struct Tank {
  int left = 0, nx = 0, low = 0, ny = 0;  // of lattice cells of 0.1
  std::string planes;
  Real mu = 20, endtim = 0.05;
  std::string section = "1,1.2,1,1", gravity;
  bool boxed = false;  ///< particles with |x| > `half_box` are outside the computational box
  Real half_box = 0.5;

  static Id id_of(int column, int row) { return 1000 * (row + 100) + column + 100; }
  /// Symmetric about x = 0 and y = 0, of period 2 in x.
  static Vec velocity(Real x, Real y) {
    return {std::sin(pi * x) * (1 + 0.3 * std::cos(pi * y)), std::cos(pi * x) * std::sin(0.7 * y), 0};
  }
  std::string deck() const {
    std::string out = "*KEYWORD\n*CONTROL_TERMINATION\n" + fmt::format("{}\n", endtim) +
                      fmt::format("*CONTROL_SPH\n1,{},1e20,2\n0,0,0,0,0,0,0\n", boxed ? 1 : 0) +
                      (boxed ? fmt::format("*DEFINE_BOX\n1,{},{},-9,9,-1,1\n", -half_box, half_box) : "") +
                      "*PART\nwater\n1,1,1,1\n*SECTION_SPH\n" + section + "\n*MAT_NULL\n" +
                      fmt::format("1,1000.0,-1e20,{}\n*EOS_LINEAR_POLYNOMIAL\n1,0,4e5\n\n", mu) + planes +
                      gravity;
    std::string nodes = "*NODE\n", elements = "*ELEMENT_SPH\n", velocities = "*INITIAL_VELOCITY_NODE\n";
    for (int column = left; column < left + nx; ++column)
      for (int row = low; row < low + ny; ++row) {
        const Real x = 0.1 * column + 0.05, y = 0.1 * row + 0.05;
        const Vec v = velocity(x, y);
        const Id id = id_of(column, row);
        nodes += fmt::format("{},{:.17g},{:.17g},0\n", id, x, y);
        elements += fmt::format("{},1,10.0\n", id);
        velocities += fmt::format("{},{:.17g},{:.17g},0\n", id, v[0], v[1]);
      }
    return out + nodes + elements + velocities + "*END\n";
  }
};

States run(const Tank& tank, Simulation** keep = nullptr) {
  auto s = test::build_deck(tank.deck());
  States out;
  if (!s) return out;
  while (s->clock().t < tank.endtim)
    s->step([&](World& world, const Clock& clock, const std::string&) {
      sample_energy(world, clock);
      if (clock.cycle == 0) world.energy.initial = world.energy.total();
    });
  EXPECT_GT(s->clock().cycle, 9);
  const Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i) out[p.id[i]] = {p.x.vec(i), p.v.vec(i), p.rho[i], p.p[i]};
  if (keep) *keep = s.release();
  return out;
}

/// Of every particle of `part`; `shift` brings its position to that in `whole`.
void expect_same(const States& part, const States& whole, Real period = 0) {
  ASSERT_FALSE(part.empty());
  Real moved = 0;
  for (const auto& [id, s] : part) {
    const State& w = whole.at(id);
    Vec d = s.x - w.x;
    if (period > 0) d[0] -= period * std::round(d[0] / period);
    ASSERT_LT(d.norm(), 1e-12) << id;
    ASSERT_LT((s.v - w.v).norm(), 1e-10) << id;
    ASSERT_NEAR(s.rho, w.rho, 1e-8) << id;
    moved = std::max(moved, s.v.norm());
  }
  EXPECT_GT(moved, 0.5);
}

const std::string mirror_x = "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,1,0,0\n";
const std::string mirror_y = "*BOUNDARY_SPH_SYMMETRY_PLANE\n7,0,0,7,2,0\n";
const std::string periodic_x =
    "*DEFINE_VECTOR\n1,-1,0,0,5,0,0\n2,1,0.3,0,-1,0.3,0\n*BOUNDARY_SPH_PERIODIC\n1,2\n";

TEST(Ghosts, TheSecondPeriodicPlaneIsTheFirst) {
  std::string text =
                  "*KEYWORD\n*CONTROL_TERMINATION\n1.\n*CONTROL_SPH\n1,0,1e20,2\n*PART\nwater\n1,1,1,1\n*"
                  "SECTION_SPH\n1,1.2\n"
                  "*MAT_NULL\n1,1000.0\n*EOS_LINEAR_POLYNOMIAL\n1,0,9e5\n*DEFINE_VECTOR\n1,0.3,0,0,1,0,0\n2,"
                  "0.9,0,0,0,0,0\n"
                  "*BOUNDARY_SPH_PERIODIC\n1,2\n*NODE\n",
              elements = "*ELEMENT_SPH\n";
  for (int k = 0; k < 12; ++k) {  // x = 0.4 to 0.9, and the planes at 0.3 and 0.9
    text += fmt::format("{},{:.17g},{:.17g},0\n", k + 1, 0.1 * (k % 6) + 0.4, 0.1 * (k / 6));
    elements += fmt::format("{},1,10.0\n", k + 1);
  }
  const auto s = test::build_deck(text + elements + "*END\n");
  ASSERT_NE(s, nullptr);
  Index wrapped = 0;
  const Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i) {
    EXPECT_GE(p.x.vec(i)[0], 0.3);
    EXPECT_LT(p.x.vec(i)[0], 0.85);
    wrapped += std::abs(p.x.vec(i)[0] - 0.3) < 1e-12;
  }
  EXPECT_EQ(wrapped, 2);
}

}  // namespace

TEST(GhostParticles, PartOfATankBehindMirrorsIsTheWholeTank) {
  Simulation *kept_half = nullptr, *kept_whole = nullptr;
  const States half = run({.left = 0, .nx = 10, .low = 0, .ny = 10, .planes = mirror_x}, &kept_half);
  const States whole = run({.left = -10, .nx = 20, .low = 0, .ny = 10}, &kept_whole);
  const std::unique_ptr<Simulation> a(kept_half), b(kept_whole);
  expect_same(half, whole);
  const EnergyLedger &of_half = a->world().energy, &of_whole = b->world().energy;
  EXPECT_NEAR(2 * of_half.kinetic, of_whole.kinetic, 1e-9 * of_whole.initial);
  EXPECT_NEAR(2 * of_half.internal, of_whole.internal, 1e-9 * of_whole.initial);
  EXPECT_NEAR(2 * of_half.dissipated, of_whole.dissipated, 1e-9 * of_whole.initial);
  EXPECT_EQ(of_half.external_work, 0);
}

TEST(GhostParticles, OfTheHaloDoWorkAsTheHaloDoes) {
  // a stream out of both sides of a box, of which the upper half is computed
  Simulation *kept_half = nullptr, *kept_whole = nullptr;
  Tank tank{.left = -12, .nx = 24, .low = 0, .ny = 10, .planes = mirror_y, .endtim = 0.1, .boxed = true};
  run(tank, &kept_half);
  tank.low = -10, tank.ny = 20, tank.planes.clear();
  run(tank, &kept_whole);
  const std::unique_ptr<Simulation> a(kept_half), b(kept_whole);
  ASSERT_GT(a->world().particles.moving, a->world().particles.active);
  const EnergyLedger &of_half = a->world().energy, &of_whole = b->world().energy;
  EXPECT_GT(std::abs(of_whole.external_work), 0.05 * of_whole.initial);
  EXPECT_NEAR(2 * of_half.external_work, of_whole.external_work, 1e-9 * of_whole.initial);
  EXPECT_NEAR(2 * of_half.throughput, of_whole.throughput, 1e-9 * of_whole.initial);
}

TEST(GhostParticles, AQuarterBehindTwoMirrorsIsTheWholeTank) {
  expect_same(run({.left = 0, .nx = 10, .low = 0, .ny = 10, .planes = mirror_x + mirror_y}),
              run({.left = -10, .nx = 20, .low = -10, .ny = 20}));
}

TEST(GhostParticles, SmoothingLengthsThatChangeAreMirrored) {
  expect_same(run({.left = 0, .nx = 10, .low = 0, .ny = 10, .planes = mirror_x, .section = "1,1.2,0.5,2"}),
              run({.left = -10, .nx = 20, .low = 0, .ny = 10, .section = "1,1.2,0.5,2"}));
}

TEST(GhostParticles, APeriodicTankIsTwoOfThemInARow) {
  const std::string twice =
      "*DEFINE_VECTOR\n1,-1,0,0,5,0,0\n2,3,0.3,0,-1,0.3,0\n*BOUNDARY_SPH_PERIODIC\n1,2\n";
  expect_same(run({.left = -10, .nx = 20, .low = 0, .ny = 10, .planes = periodic_x, .endtim = 0.2}),
              run({.left = -10, .nx = 40, .low = 0, .ny = 10, .planes = twice, .endtim = 0.2}), 2);
}

TEST(GhostParticles, APeriodicTankMayStandInABoxThatEndsAtItsPlanes) {
  Tank tank{.left = -10, .nx = 20, .low = 0, .ny = 10, .planes = periodic_x, .endtim = 0.2};
  const States open = run(tank);
  tank.boxed = true, tank.half_box = 1;
  expect_same(run(tank), open, 2);
}

/// A stream of `rows` rows, faster at some heights than at others, that comes through x = 0 into a box which
/// it leaves again, between periodic planes below and above it.
std::unique_ptr<Simulation> run_stream(int rows) {
  const Real width = 0.1 * rows;
  std::string nodes = "*NODE\n", elements = "*ELEMENT_SPH\n", velocities = "*INITIAL_VELOCITY_NODE\n";
  for (int column = 0; column < 10; ++column)
    for (int row = 0; row < rows; ++row) {
      const Real x = 0.1 * column + 0.05, y = 0.1 * row + 0.05;
      const int id = 100 * column + row + 1;
      nodes += fmt::format("{},{:.17g},{:.17g},0\n", id, x, y);
      elements += fmt::format("{},1,10.0\n", id);
      velocities += fmt::format("{},{:.17g},{:.17g},0\n", id, 3 + 0.5 * std::cos(2 * pi * y),
                                std::sin(2 * pi * (x + y)));
    }
  auto s = test::build_deck(
      "*KEYWORD\n*CONTROL_TERMINATION\n0.2\n*CONTROL_SPH\n1,1,1e20,2\n0,0,0,0,0,0,0\n" +
      fmt::format("*DEFINE_BOX\n1,0,0.8,0,{},-1,1\n*DEFINE_VECTOR\n1,0,0,0,0,1,0\n2,0,{},0,0,0,0\n", width,
                  width) +
      "*BOUNDARY_SPH_PERIODIC\n1,2\n*PART\nwater\n1,1,1,1\n*PART\ninflow\n2,1,1,1\n*SECTION_SPH\n1,1.2,1,1\n"
      "*MAT_NULL\n1,1000.0,-1e20,20\n*EOS_LINEAR_POLYNOMIAL\n1,0,4e5\n\n" +
      fmt::format("*DEFINE_SPH_INJECTION_SIMPLIFIED\n2,3,{},0.1\n0,{},0,1,0,0\n", width / 2, width / 2) +
      nodes + elements + velocities + "*END\n");
  while (s && s->clock().t < 0.2)
    s->step([&](World& world, const Clock& clock, const std::string&) {
      sample_energy(world, clock);
      if (clock.cycle == 0) world.energy.initial = world.energy.total();
    });
  return s;
}

TEST(GhostParticles, AnInletBetweenPeriodicPlanesIsHalfOfOneTwiceAsWide) {
  const auto once = run_stream(10), twice = run_stream(20);
  ASSERT_TRUE(once && twice);
  const EnergyLedger &a = once->world().energy, &b = twice->world().energy;
  Real inflow = 0, across = 0;
  const Particles& p = once->world().particles;
  for (Index i = 0; i < p.active; ++i)
    if (p.part[i] == 1) inflow += p.m[i], across = std::max(across, std::abs(p.v.vec(i)[1]));
  EXPECT_NEAR(inflow, 1000 * 3 * 0.2, 1000 * 3 * 0.2 * 0.1);  // over 1 m of width, by half a layer
  EXPECT_GT(across, 0.1);                                     // it feels the water before it
  EXPECT_EQ(2 * p.active, twice->world().particles.active);
  EXPECT_LT(p.active, 100 + 60);  // some have left the box
  EXPECT_NEAR(2 * a.kinetic, b.kinetic, 1e-9 * b.initial);
  EXPECT_NEAR(2 * a.internal, b.internal, 1e-9 * b.initial);
  EXPECT_NEAR(2 * a.dissipated, b.dissipated, 1e-9 * b.initial);
  EXPECT_NEAR(2 * a.throughput, b.throughput, 1e-9 * b.initial);
}

TEST(GhostParticles, SameBitsOnAnyNumberOfThreads) {
  std::vector<States> all;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    all.push_back(run({.left = -10, .nx = 20, .low = 0, .ny = 10, .planes = periodic_x + mirror_y}));
  }
  set_threads(0);
  for (const States& other : {all[1], all[2]})
    for (const auto& [id, s] : all[0]) {
      ASSERT_EQ(s.x, other.at(id).x);
      ASSERT_EQ(s.v, other.at(id).v);
      ASSERT_EQ(s.rho, other.at(id).rho);
    }
}

TEST(GhostParticles, WhatGoesThroughAMirrorComesBackAsItsGhost) {
  World world;
  Particles& p = world.particles;
  p.fields.resize(1);
  p.x.set(0, {0.3, 0, 0}), p.v.set(0, {-1, 2, 0}), p.m[0] = 2, p.active = 1;
  GhostParticles ghosts({{GhostPlane::Kind::mirror, {0.5, 0, 0}, {1, 0, 0}, 0}});
  ghosts.bring_back(world, 1);
  EXPECT_LT((p.x.vec(0) - Vec(0.7, 0, 0)).norm(), 1e-15);
  EXPECT_LT((p.v.vec(0) - Vec(1, 2, 0)).norm(), 1e-15);
  EXPECT_TRUE(ghosts.brought_back().empty());
  EXPECT_EQ(world.counters.at("mirror_crossings"), 1);
  ghosts.bring_back(world, 1);
  EXPECT_EQ(world.counters.at("mirror_crossings"), 1);
}

TEST(GhostParticles, StopsWhereParticlesReachAcrossTheDomain) {
  World world;
  GhostParticles between({{GhostPlane::Kind::mirror, Vec(1, 0, 0), Vec(1, 0, 0), 0},
                          {GhostPlane::Kind::mirror, Vec(1.5, 0, 0), Vec(-1, 0, 0), 0},
                          {GhostPlane::Kind::periodic, Vec(0, 2, 0), Vec(0, 1, 0), 0.7}});
  EXPECT_NO_THROW(between.build(world, 0.49, 0.1));
  EXPECT_THROW(between.build(world, 0.51, 0.1), RunError);
  GhostParticles period({{GhostPlane::Kind::periodic, Vec(0, 2, 0), Vec(0, 1, 0), 0.7}});
  EXPECT_NO_THROW(period.build(world, 0.69, 0.1));
  EXPECT_THROW(period.build(world, 0.71, 0.1), RunError);
}

TEST(GhostParticles, GravityAlongAPeriodicChannelDoesWork) {
  // falls freely through the planes again and again; potential energy jumps there, the ledger must not
  Simulation* kept = nullptr;
  run({.left = -10,
       .nx = 20,
       .low = 0,
       .ny = 10,
       .planes = periodic_x,
       .mu = 0,
       .endtim = 0.5,
       .gravity = "*LOAD_BODY_X\n1,-20.0\n*DEFINE_CURVE\n1\n0,1\n100,1\n"},
      &kept);
  const std::unique_ptr<Simulation> s(kept);
  ASSERT_NE(s, nullptr);
  const EnergyLedger& e = s->world().energy;
  EXPECT_NEAR(e.external_work, 2000 * 0.5 * 100, 0.3 * 2000 * 50);  // m v^2/2 at v = 20 x 0.5
  EXPECT_LT(std::abs(e.residual()), 0.01 * e.throughput);           // a jump that is forgotten would be 80 %
}

TEST(GhostParticles, AParticleThatBouncesOnAMirrorKeepsItsEnergy) {
  const std::string deck =
      "*KEYWORD\n*CONTROL_TERMINATION\n6\n*CONTROL_SPH\n1,0,1e20,2\n0,0,0,0,0,0,0\n*PART\nwater\n1,1,1,1,1\n*"
      "HOURGLASS\n1,0,0,0,1e-20,1e-20\n"
      "*SECTION_SPH\n1,1.2,1,1,0.02\n*MAT_NULL\n1,1000.0,0\n*EOS_LINEAR_POLYNOMIAL\n1,0,1e-3\n\n"
      "*CONTROL_TIMESTEP\n0,0.5,0,0,0,2\n*DEFINE_CURVE\n2\n0,1e-3\n9,1e-3\n"
      "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,0,1,0\n*LOAD_BODY_Y\n1,10.0\n*DEFINE_CURVE\n1\n0,1\n100,1\n"
      "*NODE\n1,0,0.5,0\n*ELEMENT_SPH\n1,1,0.1\n*INITIAL_VELOCITY_NODE\n1,0,-3\n*END\n";
  const auto s = test::build_deck(deck);
  ASSERT_TRUE(s);
  Real lowest = 1e9, highest = 0;
  while (s->clock().t < 6)
    s->step([&](World& world, const Clock& clock, const std::string&) {
      sample_energy(world, clock);
      if (clock.cycle == 0) world.energy.initial = world.energy.total();
      lowest = std::min(lowest, world.energy.total());
      highest = std::max(highest, world.energy.total());
    });
  EXPECT_GT(s->world().counters.at("mirror_crossings"), 1);
  EXPECT_EQ(s->world().energy.external_work, 0);
  // m v^2/2 = 0.45, heights count from where it starts; kinetic energy lags by half a step, m g v dt/2 =
  // 0.002
  EXPECT_NEAR(lowest, 0.45, 0.04);  // ten bounces, each less by m g v dt = 0.003
  EXPECT_NEAR(highest, 0.45, 0.005);
}

}  // namespace courant
