#include "loads/loads.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../sph/cloud.hpp"
#include "loads/point_motion.hpp"
#include "state/reports.hpp"
#include "time/step.hpp"

using namespace courant;

namespace {

struct Steps : TimeLimit {
  Real dt;
  bool change;
  Steps(Real dt, bool change) : dt(dt), change(change) {}
  std::string name() const override { return "steps"; }
  bool rings() const override { return false; }
  Limit limit(const World&, const Clock& clock) override {
    return {change ? dt * static_cast<Real>(1 + (clock.cycle * 7) % 5) : dt, "test"};
  }
};

Curve constant(Real value) {
  return {.id = 1, .abscissa = {0, 1}, .ordinate = {value, value}};
}
BodyLoad along(const Vec& direction, Real value, std::vector<Index> parts = {}) {
  return {.direction = direction, .curve = constant(value), .parts = std::move(parts)};
}
BodyLoad about_z(const Curve& curve, const Vec& centre, std::vector<Index> parts = {}) {
  return {.kind = BodyLoad::Kind::rotation,
          .direction = Vec::UnitZ(),
          .centre = centre,
          .curve = curve,
          .parts = std::move(parts)};
}

/// One particle (id 1, part 0) and two nodes (11, and 12, which a rigid body moves), each of mass 2.
struct Scene {
  test::Cloud cloud{3, 1, 0.01, 0};
  World& w = cloud.world;
  Model model;
  PassTimer timer;
  std::unique_ptr<Stepper> stepper;
  Real kinetic = 0;  ///< of particle and node at t^n, when the ledger was sampled

  Scene() {
    w.particles.m[0] = 2;
    w.nodes.fields.resize(2);
    for (Index n = 0; n < 2; ++n) {
      w.nodes.id[n] = 11 + n, w.nodes.m[n] = 2, w.nodes.held[n] = 0, w.nodes.follow[n] = n;
      w.nodes.x.set(n, Vec::Zero()), w.nodes.v.set(n, Vec::Zero()), w.nodes.f.set(n, Vec::Zero());
    }
    model.nodes.resize(3);
    model.nodes[0].id = 1, model.nodes[1].id = 12, model.nodes[2].id = 11;
    model.sph.push_back({0, 0, 2.0, {}});
  }
  std::array<Points, 2> sets() { return {points_of(w.particles), points_of(w.nodes)}; }
  void place(const Vec& x, const Vec& v) {
    for (const Points& p : sets()) p.x->set(0, x), p.v->set(0, v);
  }
  void load(const BodyAcceleration& a) {
    w.passes.add(make_body_load(a, points_of(w.particles), w, cloud.neighbours));
    w.passes.add(make_body_load(a, points_of(w.nodes), w));
  }
  void start(Real dt, bool change = false) {
    for (const Points& p : sets()) {
      w.passes.add(make_clear_forces(p));
      w.passes.add(make_point_motion(p));
    }
    w.passes.add(std::make_shared<Steps>(dt, change));
    stepper = std::make_unique<Stepper>(w, cloud.neighbours.get(), StepRules{}, timer);
  }
  /// The energy that the ledger does not know of: 0 where all is counted.
  Real residual() const {
    return kinetic + w.energy.potential + w.energy.dissipated - w.energy.external_work;
  }
  void steps(int n) {
    for (int k = 0; k < n; ++k)
      stepper->step(cloud.clock, [&](World& world, const Clock& clock, const std::string&) {
        sample_energy(world, clock);
        kinetic = 0;
        for (const Points& p : sets()) {
          const Vec v = p.v->vec(0) + p.f->vec(0) / (*p.m)[0] * 0.5 * clock.dt_mean();
          kinetic += 0.5 * (*p.m)[0] * v.squaredNorm();
        }
      });
  }
};

const std::vector<BodyLoad> mixed = {along(Vec::UnitY(), 9.81), about_z(constant(3), Vec(1, 2, 5)),
                                     along(Vec(0.6, 0, 0.8), 2, {1})};

}  // namespace

TEST(BodyAcceleration, IsWhatItsPotentialFallsBy) {
  const BodyAcceleration a(mixed);
  for (const Index part : {-1, 0, 1}) {
    const Vec x(0.3, -0.7, 1.1);
    constexpr Real e = 1e-5;
    for (int k = 0; k < 3; ++k) {
      const Vec d = e * Vec::Unit(k);
      const Real slope = (a.potential(x + d, 0, part) - a.potential(x - d, 0, part)) / (2 * e);
      EXPECT_NEAR(a(x, 0, part)[k], -slope, 1e-8);
    }
    const Vec step(0.4, 0.5, -0.2);
    EXPECT_NEAR(a.at(0).rise(x, step, part), a.potential(x + step, 0, part) - a.potential(x, 0, part), 1e-13);
  }
}

TEST(BodyAcceleration, OpposesTheBaseAndFliesFromTheAxis) {
  const BodyAcceleration a(mixed);
  const Vec x(1.5, 2, 0);
  EXPECT_LT((a(x, 0, 0) - Vec(9 * 0.5, -9.81, 0)).norm(), 1e-14);
  EXPECT_LT((a(x, 0, 1) - Vec(9 * 0.5 - 1.2, -9.81, -1.6)).norm(), 1e-14);
}

TEST(BodyAcceleration, KnowsWhatItIsForSomeParts) {
  EXPECT_TRUE(BodyAcceleration().none());
  EXPECT_TRUE(BodyAcceleration({along(Vec::UnitX(), 1)}).uniform());
  const BodyAcceleration a(
      {along(Vec::UnitX(), 1), along(Vec::UnitY(), 2, {1, 2}), along(Vec::UnitZ(), 4, {3})});
  EXPECT_FALSE(a.uniform());
  EXPECT_TRUE(a.by_parts());
  const std::vector<Index> fluid = {1, 2}, both = {0, 1};
  EXPECT_TRUE(a.on(fluid).uniform());
  EXPECT_EQ(a.on(fluid).at(0).everywhere(), Vec(-1, -2, 0));
  EXPECT_FALSE(a.on(both).uniform());
  EXPECT_EQ(a.on(both)(Vec::Zero(), 0, 0), Vec(-1, 0, 0));
  EXPECT_EQ(a.without(Vec::UnitX()).at(0).everywhere(), Vec(0, 0, 0));
  EXPECT_EQ(a.without(Vec::UnitX())(Vec::Zero(), 0, 1), Vec(0, -2, 0));
  EXPECT_FALSE(BodyAcceleration({about_z(constant(1), Vec::Zero())}).uniform());
}

TEST(BodyLoad, FreeFallIsExactWithChangingSteps) {
  Scene s;
  s.place(Vec::Zero(), Vec(1, 2, 0));
  s.load(BodyAcceleration({along(Vec::UnitY(), 9.81)}));
  s.start(1e-3, true);
  s.steps(100);
  const Real t = s.cloud.clock.t;
  for (const Points& p : s.sets())
    EXPECT_LT((p.x->vec(0) - Vec(t, 2 * t - 0.5 * 9.81 * t * t, 0)).norm(), 1e-12);
  EXPECT_EQ(s.w.nodes.f.vec(1), Vec::Zero()) << "what a rigid body moves gets its load there";
  EXPECT_EQ(s.w.nodes.x.vec(1), Vec::Zero());
}

TEST(BodyLoad, ATurningFrameDrivesOutwardsAsTheoryTells) {
  Scene s;
  const Vec centre(0.5, 0, 3);
  s.place(Vec(0.7, 0, 0), Vec(0, 0, 0.1));
  s.load(BodyAcceleration({about_z(constant(2), centre)}));
  s.start(1e-4);
  s.steps(1);
  const Real before = s.residual();
  s.steps(9999);
  const Real t = s.cloud.clock.t;
  for (const Points& p : s.sets())
    EXPECT_LT((p.x->vec(0) - Vec(0.5 + 0.2 * std::cosh(2 * t), 0, 0.1 * t)).norm(), 1e-6);
  EXPECT_GT(s.kinetic, 1);
  EXPECT_NEAR(s.residual(), before, 1e-6 * s.kinetic);
}

TEST(BodyLoad, WhatChangesInTimeDoesExternalWork) {
  Scene s;
  s.place(Vec(0.7, 0.1, 0), Vec::Zero());
  s.load(BodyAcceleration({about_z({.id = 1, .abscissa = {0, 1}, .ordinate = {0, 3}}, Vec(0.5, 0, 0)),
                           {.direction = Vec::UnitY(), .curve = {.abscissa = {0, 1}, .ordinate = {0, 5}}}}));
  s.start(1e-4);
  s.steps(1);
  const Real before = s.residual();
  s.steps(9999);
  EXPECT_GT(std::abs(s.w.energy.external_work), 0.1);
  EXPECT_NEAR(s.residual(), before, 1e-3 * s.kinetic);
}

TEST(BodyLoad, ActsOnItsPartsOnly) {
  for (const Index part : {0, 1}) {
    Scene s;
    s.w.particles.part[0] = part;
    s.load(BodyAcceleration({along(Vec::UnitX(), 3, {1})}));
    s.start(1e-3);
    s.steps(10);
    EXPECT_NEAR(s.w.particles.x.vec(0)[0], part == 1 ? -0.5 * 3 * 1e-4 : 0, 1e-15);
    EXPECT_EQ(s.w.nodes.x.vec(0)[0], 0) << "a node that belongs to no part";
  }
}

TEST(FixedPoints, HoldNodesAndTellWhatForce) {
  Scene s;
  s.model.nodes[2].fixed = {true, false, true};
  s.model.nodes[1].fixed = {true, true, true};
  s.model.output.histories["spcforc"].times.interval = 1;
  EXPECT_EQ(make_fixed_points(s.model, points_of(s.w.particles), s.w), nullptr);
  s.place(Vec::Zero(), Vec(1, 1, 1));
  auto pass = make_fixed_points(s.model, points_of(s.w.nodes), s.w);
  ASSERT_NE(pass, nullptr);
  EXPECT_EQ(pass->name(), "fixed nodes (SPC)");
  s.w.passes.add(pass);
  s.load(BodyAcceleration({along(Vec::UnitX(), 3), along(Vec::UnitY(), 4)}));
  s.start(1e-3);
  s.steps(10);
  EXPECT_EQ(s.w.nodes.x.vec(0)[0], 0);
  EXPECT_EQ(s.w.nodes.x.vec(0)[2], 0);
  EXPECT_NEAR(s.w.nodes.x.vec(0)[1], 0.01 - 0.5 * 4 * 1e-4, 1e-15);
  std::vector<BoundaryForce> forces;
  dynamic_cast<const BoundaryForceReporter&>(*pass).report_forces(s.w, s.cloud.clock, forces);
  ASSERT_EQ(forces.size(), 1U);
  EXPECT_EQ(forces[0].id, 11);
  EXPECT_EQ(forces[0].force, Vec(6, 0, 0));
}

TEST(PrescribedPoints, DriveParticlesAndNodes) {
  Scene s;
  Deck deck;
  Diagnostics diagnostics;
  s.model.output.histories["bndout"].times.interval = 1;
  PrescribedMotion motion{.direction = Vec::UnitX(),
                          .curve = {.abscissa = {0, 1}, .ordinate = {0, 2}},
                          .nodes = {0, 2},
                          .card = {}};
  ASSERT_TRUE(add_prescribed_points({motion}, deck, s.model, {}, s.w, diagnostics));
  s.load(BodyAcceleration({along(Vec::UnitX(), 5)}));
  s.start(1e-3);
  s.steps(1);
  const Real before = s.residual();
  s.steps(499);
  for (const Points& p : s.sets()) EXPECT_NEAR(p.x->vec(0)[0], 0.25, 1e-12);
  // drives do the work against the load and that of the acceleration: 2 x (2 5 0.25 + 0.5 2 1)
  EXPECT_NEAR(s.w.energy.external_work, 2 * (2.5 + 1), 0.03);
  EXPECT_NEAR(s.residual(), before, 0.03);
}

TEST(PrescribedPoints, RefuseNodesOfRigidBodies) {
  Scene s;
  Deck deck;
  Diagnostics diagnostics;
  const PrescribedMotion motion{.direction = Vec::UnitX(), .curve = constant(1), .nodes = {1}, .card = {}};
  EXPECT_FALSE(add_prescribed_points({motion}, deck, s.model, {}, s.w, diagnostics));
  EXPECT_NE(diagnostics.text().find("node 12 is neither a particle nor a node of deformable elements"),
            std::string::npos);
}

TEST(NodalLoads, DoTheWorkThatBecomesKineticEnergy) {
  Scene s;
  const NodalLoad push{.direction = Vec::UnitX(),
                       .curve = {.abscissa = {0, 0.5, 1}, .ordinate = {0, 4, 1}},
                       .sf = 3,
                       .nodes = {0, 2}};
  const NodalLoad more{.direction = Vec::UnitY(), .curve = constant(2), .sf = -1, .nodes = {2, 1}};
  s.place(Vec::Zero(), Vec(-0.3, 0.2, 0));
  for (const Points& p : s.sets()) s.w.passes.add(make_nodal_loads({push, more}, s.model, p, s.w));
  s.start(1e-3, true);
  s.steps(1);
  const Real before = s.residual();
  s.steps(300);
  const Real t = s.cloud.clock.t;
  ASSERT_GT(t, 0.5);
  EXPECT_LT(s.w.particles.v.vec(0)[1], 0.2 + 1e-12);
  EXPECT_LT(s.w.nodes.v.vec(0)[1], 0.2 - 0.9 * t);
  EXPECT_GT(s.w.particles.v.vec(0)[0], 1);
  EXPECT_NEAR(s.residual(), before, 1e-2 * s.kinetic);
  EXPECT_EQ(s.w.nodes.x.vec(1), Vec::Zero());
}

TEST(NodalLoads, AreNoneWhereNoNodeIsThere) {
  Scene s;
  const NodalLoad on_rigid{.direction = Vec::UnitX(), .curve = constant(1), .nodes = {1}};
  for (const Points& p : s.sets())
    EXPECT_EQ(make_nodal_loads({on_rigid}, s.model, p, s.w) == nullptr, p.set == &s.w.particles.fields);
  for (const Points& p : s.sets()) EXPECT_EQ(make_nodal_loads({}, s.model, p, s.w), nullptr);
}

TEST(Damping, SlowsDownAsTheoryTells) {
  Scene s;
  s.place(Vec::Zero(), Vec(1, 1, 1));
  const Damping d{.curve = {}, .sf = 3, .scale = Vec(1, 0.5, 0)};
  for (const Points& p : s.sets()) s.w.passes.add(make_damping({d}, p, s.w));
  s.start(1e-4);
  s.steps(1);
  const Real before = s.residual();
  s.steps(9999);
  const Real t = s.cloud.clock.t;
  for (const Points& p : s.sets()) {
    EXPECT_NEAR(p.x->vec(0)[0], (1 - std::exp(-3 * t)) / 3, 1e-4);
    EXPECT_NEAR(p.x->vec(0)[1], (1 - std::exp(-1.5 * t)) / 1.5, 1e-4);
    EXPECT_NEAR(p.x->vec(0)[2], t, 1e-12);
  }
  EXPECT_GT(s.w.energy.dissipated, 1);
  EXPECT_NEAR(s.residual(), before, 1e-3);
}

TEST(Damping, AnOscillatorDecays) {
  struct Spring : Force {
    Points p;
    explicit Spring(Points points) : p(points) {}
    std::string name() const override { return "spring of " + p.set->name(); }
    const FieldSet& over(const World&) const override { return p.fields(); }
    void declare(const World&, Accesses& a) const override { a.reads(*p.x).reads(*p.m).updates(*p.f); }
    void block(World&, const Clock&, Index begin, Index end) override {
      for (Index i = begin; i < end; ++i) p.f->add(i, -400 * (*p.m)[i] * p.x->vec(i));
    }
  };
  Scene s;
  s.place(Vec(1, 0, 0), Vec::Zero());
  for (const Points& p : s.sets()) {
    s.w.passes.add(std::make_shared<Spring>(p));
    s.w.passes.add(make_damping({{.curve = constant(2), .sf = 0.5}}, p, s.w));
  }
  s.start(1e-4);
  s.steps(20000);
  const Real t = s.cloud.clock.t, w = std::sqrt(400 - 0.25);
  const Real expected = std::exp(-0.5 * t) * (std::cos(w * t) + 0.5 / w * std::sin(w * t));
  for (const Points& p : s.sets()) EXPECT_NEAR(p.x->vec(0)[0], expected, 1e-4);
}

TEST(Damping, ActsOnItsPartsOnlyAndAtAnyStep) {
  Scene s;
  s.place(Vec::Zero(), Vec(1, 0, 0));
  const Damping stiff{.curve = {}, .sf = 1e4, .scale = Vec::Ones(), .parts = {0}};
  s.w.nodes.part[0] = 1;
  for (const Points& p : s.sets()) s.w.passes.add(make_damping({stiff}, p, s.w));
  s.start(1e-3);
  s.steps(1);
  EXPECT_LE(std::abs(s.w.particles.v.vec(0)[0]), 1) << "the first step, which follows none";
  s.steps(50);
  EXPECT_LT(std::abs(s.w.particles.v.vec(0)[0]), 1e-6);
  EXPECT_EQ(s.w.nodes.v.vec(0)[0], 1);
  EXPECT_GE(s.w.energy.dissipated, 0);
  EXPECT_NEAR(s.w.energy.dissipated, 1, 1e-3);
}
