// Every optional term of the SPH passes, switched on.
#include <gtest/gtest.h>

#include <cmath>

#include "cloud.hpp"
#include "liquid.hpp"
#include "loads/loads.hpp"
#include "loads/point_motion.hpp"
#include "sph/core/fields.hpp"
#include "time/step.hpp"

using namespace courant;
using courant::test::Cloud;
using courant::test::ConstantStep;
using courant::test::liquid_pass;

namespace {

TimeLimit::Limit limit_of(Cloud& cloud, const Model& model) {
  World& w = cloud.world;
  w.passes = {};
  add_sph_time_limit(cloud.settings, model, w);
  cloud.run(*w.passes.in_phase(Phase::reductions, w).at(0));
  return w.passes.all<TimeLimit>().at(0)->limit(w, cloud.clock);
}

void step(Cloud& cloud, int times) {
  PassTimer timer;
  Stepper stepper(cloud.world, cloud.neighbours.get(), {}, timer);
  for (int k = 0; k < times; ++k) stepper.step(cloud.clock, [](World&, const Clock&, const std::string&) {});
}

}  // namespace

TEST(SmoothingLength, FollowsTheDensityAndStopsAtItsBounds) {
  Cloud cloud(2, 10, 0.01, 0);
  World& w = cloud.world;
  cloud.settings.h_max_factor.assign(1, 1.1);
  cloud.settings.h_min_factor.assign(1, 0.9);
  auto pass = make_smoothing_length(cloud.settings, w);
  cloud.refresh();
  cloud.clock.dt = 1e-3;
  Real rho = 1000;
  for (int k = 0; k < 50; ++k) {  // expands: drho/dt = -rho
    w.particles.drhodt.fill(-rho);
    w.particles.rho.fill(rho);
    cloud.run(*pass);
    rho -= rho * 1e-3;
  }
  EXPECT_NEAR(w.particles.h[0], 0.012 * std::pow(1 + 0.5e-3, 50), 1e-14);  // 50 explicit steps of h div v / 2
  EXPECT_EQ(w.counters.at("smoothing_length_at_bound"), 0);
  for (int k = 0; k < 300; ++k) cloud.run(*pass);
  EXPECT_DOUBLE_EQ(w.particles.h[0], 1.1 * 0.012);
  EXPECT_EQ(w.counters.at("smoothing_length_at_bound"), w.particles.size());
}

TEST(SphTimeLimit, IsTheSmallestOfEquation18AndOfViscosity) {
  Cloud cloud(2, 4, 0.01, 0);
  Particles& p = cloud.world.particles;
  Model model;
  model.parts.push_back({.id = 7});
  cloud.settings.tssfac = 0.8;
  cloud.refresh();
  p.v.set(5, {3, 4, 0});
  p.h[6] = 0.011;
  const auto acoustic = limit_of(cloud, model);
  EXPECT_NEAR(acoustic.dt, 0.8 * 0.012 / (30 + 5), 1e-15);
  EXPECT_EQ(acoustic.who, "sph " + std::to_string(p.id[5]) + " of part 7");
  cloud.settings.mu.assign(1, 900);
  const auto viscous = limit_of(cloud, model);
  EXPECT_NEAR(viscous.dt, 0.8 * 0.125 * 1000 * 0.011 * 0.011 / 900, 1e-15);
  EXPECT_EQ(viscous.who, "sph " + std::to_string(p.id[6]) + " of part 7");
  p.c[9] = std::nan("");
  EXPECT_TRUE(std::isnan(limit_of(cloud, model).dt));
}

TEST(SpeedLimit, SwitchesOffOrClipsAndCounts) {
  for (const Real maxv : {5.0, -5.0}) {
    Cloud cloud(2, 4, 0.01, 0);
    World& w = cloud.world;
    w.particles.v.set(3, {30, 40, 0});
    const Id fast = w.particles.id[3];
    cloud.settings.maxv = maxv;
    w.passes.add(make_speed_limit(cloud.settings, cloud.neighbours));
    w.passes.add(make_clear_forces(points_of(w.particles)));
    w.passes.add(make_point_motion(points_of(w.particles)));
    w.passes.add(make_kinetic_energy(points_of(w.particles)));
    w.passes.add(std::make_shared<ConstantStep>(1e-5));
    w.passes.add(make_sph_energy(cloud.settings, w, cloud.neighbours));
    w.energy.initial = 0.5 * w.particles.m[3] * 50 * 50;
    step(cloud, 3);
    sample_energy(w, cloud.clock);
    EXPECT_NEAR(w.energy.kinetic, maxv > 0 ? 0 : w.energy.initial / 100, 1e-12);
    EXPECT_NEAR(w.energy.residual(), 0, 1e-12) << "what it took is in the ledger";
    if (maxv > 0) {
      EXPECT_EQ(w.counters.at("deactivated_by_maxv"), 1);
      EXPECT_EQ(w.particles.active, 15);
      EXPECT_EQ(w.particles.id[15], fast);
    } else {
      EXPECT_EQ(w.counters.at("speed_clipped"), 1);
      for (Index i = 0; i < 16; ++i) EXPECT_LE(w.particles.v.vec(i).norm(), 5 + 1e-12);
    }
  }
}

TEST(BulkViscosity, ActsInCompressionOnlyWithBothItsTerms) {
  Cloud cloud(2, 3, 0.01, 0);
  Particles& p = cloud.world.particles;
  const Real q1 = 0.1, q2 = 1.5, h = 0.012, c = 30, rho = 1000;
  cloud.settings.viscosity = BulkViscosity{};
  cloud.settings.q.assign(1, {q1, q2});
  auto pass = make_bulk_viscosity(cloud.settings, cloud.world);
  cloud.refresh();
  p.p.fill(7);
  for (const Real div : {-4.0, 4.0}) {
    p.drhodt.fill(-rho * div);
    cloud.run(*pass);
    auto& total = p.fields.add<Real>({.name = "pressure_plus_q"});
    auto& heat = p.fields.add<Real>({.name = "dissipation"});
    const Real q = div < 0 ? rho * h * (q2 * h * 16 + q1 * c * 4) : 0;
    for (Index i = 0; i < p.size(); ++i) {
      EXPECT_NEAR(total[i], 7 + q, 1e-11);
      EXPECT_NEAR(heat[i], q * 4 * p.m[i] / rho, 1e-12);
    }
  }
}

TEST(ViscousStress, IsTwiceViscosityTimesTheDeviatorOfTheStrainRate) {
  Cloud cloud(3, 2, 0.01, 0);
  Particles& p = cloud.world.particles;
  cloud.settings.mu.assign(1, 5.0);
  auto pass = make_viscous_stress(cloud.settings, cloud.world);
  cloud.refresh();
  const char* axes[] = {"xx", "yy", "zz", "xy", "yz", "zx"};
  const Real D[] = {1, 2, 6, 0.5, -0.25, 4}, tau[] = {-20, -10, 30, 5, -2.5, 40};
  Field<Real>&rate = sph_fields::strain_rate(p), &stress = sph_fields::stress(p);
  for (int k = 0; k < 6; ++k) std::fill_n(rate.data(k), p.size(), D[k]);
  cloud.run(*pass);
  Real power = 0;
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(stress.data(k)[0], tau[k], 1e-13) << axes[k];
    power += (k < 3 ? 1 : 2) * tau[k] * D[k];
  }
  EXPECT_NEAR(p.fields.add<Real>({.name = "viscous_dissipation"})[0], power * p.m[0] / p.rho[0], 1e-12);
}

TEST(FixedParticles, HoldTheirDirectionsOnly) {
  Cloud cloud(3, 2, 0.01, 0);
  Model model;
  model.nodes.resize(8);
  for (Index i = 0; i < 8; ++i) model.sph.push_back({i, 0, 1.0, {}});
  EXPECT_EQ(make_fixed_points(model, points_of(cloud.world.particles), cloud.world), nullptr);
  model.nodes[5].fixed = {true, false, true};
  auto pass = make_fixed_points(model, points_of(cloud.world.particles), cloud.world);
  ASSERT_NE(pass, nullptr);
  cloud.refresh();
  for (Index i = 0; i < 8; ++i)
    cloud.world.particles.f.set(i, {1, 2, 3}), cloud.world.particles.v.set(i, {4, 5, 6});
  cloud.run(*pass);
  for (Index i = 0; i < 8; ++i) {
    const bool fixed = cloud.world.particles.id[i] == 6;
    EXPECT_EQ(cloud.world.particles.f.vec(i), fixed ? Vec(0, 2, 0) : Vec(1, 2, 3));
    EXPECT_EQ(cloud.world.particles.v.vec(i), fixed ? Vec(0, 5, 0) : Vec(4, 5, 6));
  }
}

TEST(EnergyLedger, ClosesForACloudThatRunsIntoItself) {
  for (const bool monaghan : {true, false}) {
    Cloud cloud(2, 16, 0.01, 0);
    World& w = cloud.world;
    Particles& p = w.particles;
    if (!monaghan) cloud.settings.viscosity = BulkViscosity{};
    cloud.settings.mu.assign(1, 0.5);
    for (Index i = 0; i < p.size(); ++i) p.v.set(i, -2 * (p.x.vec(i) - Vec(0.075, 0.075, 0)) / 0.075);
    w.passes.add(liquid_pass(9e5, w));
    add_sph_passes(w, cloud.settings, cloud.neighbours, nullptr);
    w.passes.add(make_clear_forces(points_of(w.particles)));
    w.passes.add(make_point_motion(points_of(w.particles)));
    w.passes.add(make_kinetic_energy(points_of(w.particles)));
    w.passes.add(std::make_shared<ConstantStep>(2e-5));
    cloud.refresh();
    sample_energy(w, cloud.clock);
    w.energy.initial = w.energy.kinetic;
    Real most = 0;
    for (int k = 0; k < 250; ++k) {
      step(cloud, 1);
      sample_energy(w, cloud.clock);
      most = std::max(most, w.energy.internal);
      EXPECT_NEAR(w.energy.residual(), 0, 0.01 * w.energy.initial);
    }
    EXPECT_GT(most, 0.3 * w.energy.initial);
    EXPECT_GT(w.energy.dissipated, 0.02 * w.energy.initial);
  }
}

TEST(ParticleMotion, RimParticlesGoOnWithTheirVelocityAndFeelNoForce) {
  Cloud cloud(2, 30, 0.01, 0);
  World& w = cloud.world;
  cloud.neighbours =
      std::make_shared<Neighbours>(0.003, Neighbours::Region{Vec(-1, -1, -1), Vec(0.045, 1, 1)});
  Model model;
  model.body_loads.push_back(
      {.direction = Vec::UnitY(), .curve = {.id = 1, .abscissa = {0, 1}, .ordinate = {1, 1}}});
  w.passes.add(make_body_load(acceleration_of_particles(model), points_of(w.particles), w, cloud.neighbours));
  w.passes.add(make_clear_forces(points_of(w.particles)));
  w.passes.add(make_point_motion(points_of(w.particles)));
  w.passes.add(make_kinetic_energy(points_of(w.particles)));
  w.passes.add(std::make_shared<ConstantStep>(1e-4));
  std::map<Id, Vec> before;
  for (Index i = 0; i < w.particles.size(); ++i)
    w.particles.v.set(i, {0, 1, 0}), before[w.particles.id[i]] = w.particles.x.vec(i);
  step(cloud, 7);  // less than half the skin: nothing is sorted again
  const Particles& p = w.particles;
  ASSERT_EQ(cloud.neighbours->rebuilds(), 1);
  ASSERT_LT(p.moving, p.size());
  for (Index i = 0; i < p.size(); ++i) {
    const Real rise = p.x.vec(i)[1] - before[p.id[i]][1];
    if (i < p.active) {
      EXPECT_LT(p.v.vec(i)[1], 1);
    } else {
      EXPECT_EQ(p.v.vec(i)[1], 1);
    }
    if (i >= p.active && i < p.moving) {
      EXPECT_NEAR(rise, 7e-4, 1e-15);
    } else if (i >= p.moving) {
      EXPECT_EQ(rise, 0) << "dormant particles wait for the next sort";
    }
  }
}

TEST(Gravity, ALoadCurveThatChangesDoesExternalWork) {
  Cloud cloud(2, 3, 0.01, 0);
  World& w = cloud.world;
  Model model;
  model.body_loads.push_back(
      {.direction = Vec::UnitY(), .curve = {.id = 1, .abscissa = {0, 0.5, 1}, .ordinate = {0, 9.81, 2}}});
  w.passes.add(make_body_load(acceleration_of_particles(model), points_of(w.particles), w, cloud.neighbours));
  w.passes.add(make_sph_energy(cloud.settings, w, cloud.neighbours));
  w.passes.add(make_clear_forces(points_of(w.particles)));
  w.passes.add(make_point_motion(points_of(w.particles)));
  w.passes.add(make_kinetic_energy(points_of(w.particles)));
  w.passes.add(std::make_shared<ConstantStep>(1e-4));
  step(cloud, 1);
  sample_energy(w, cloud.clock);
  w.energy.initial = w.energy.total() - w.energy.external_work;
  step(cloud, 7000);
  sample_energy(w, cloud.clock);
  EXPECT_GT(w.energy.kinetic, 1e-3);
  EXPECT_GT(std::abs(w.energy.external_work), 0.1 * w.energy.kinetic);
  EXPECT_NEAR(w.energy.residual(), 0, 1e-3 * w.energy.kinetic);
}
