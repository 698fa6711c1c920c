// Density, energy and pressure of particles with an equation of state.
#include "sph/materials/equation_of_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../run_pass.hpp"
#include "base/run_error.hpp"
#include "sph/core/fields.hpp"
#include "sph/materials/materials.hpp"

using namespace courant;

namespace {

std::shared_ptr<EosLaw> law_of(const std::string& keyword, const std::string& cards) {
  ReadOptions options;
  options.open = [&](const std::string&) {
    return std::optional<std::string>("*KEYWORD\n*" + keyword + "\n" + cards + "*END\n");
  };
  Diagnostics diagnostics;
  const Deck deck = read_deck("eos.k", options, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  for (const EosEntry& kind : eos_registry())
    if (kind.keyword == keyword) return kind.all(deck, Model{}).at(0).second;
  return nullptr;
}
std::shared_ptr<EosLaw> polynomial_of(const std::string& cards) {
  return law_of("EOS_LINEAR_POLYNOMIAL", cards);
}

/// p = factor (1 + mu) E, an ideal gas of gamma = 1 + factor; with factor 0 a liquid of bulk modulus 9e5.
std::shared_ptr<EosLaw> polynomial(Real factor) {
  return polynomial_of("1,0.0," + std::string(factor > 0 ? "0.0" : "9.0E5") + ",0.0,0.0," +
                       std::to_string(factor) + "," + std::to_string(factor) + "\n0.0,1.0\n");
}

std::shared_ptr<EquationOfState> pass_of(std::shared_ptr<EosLaw> law, Real rho0, Real pc, World& world) {
  return std::make_shared<EquationOfState>(
      law, EosParts{{1}, true, {rho0}, {pc}},
      std::vector<const Field<Real>*>{&sph_fields::dissipation(world.particles),
                                      &sph_fields::viscous_dissipation(world.particles)},
      world);
}

/// One particle at density rho0 with the rate drhodt, after one step of 1.
World particle(Real rho, Real rate) {
  World world;
  Particles& p = world.particles;
  p.fields.resize(1);
  p.rho[0] = rho, p.drhodt[0] = rate, p.id[0] = 17;
  p.active = p.moving = 1;
  return world;
}

}  // namespace

TEST(EquationOfState, AnIdealGasStaysOnItsIsentrope) {
  // p v^gamma is constant when a gas is compressed step by step without heat
  const Real gamma = 1.4, rho0 = 1;
  const auto law = polynomial_of("1,0.0,0.0,0.0,0.0,0.4,0.4\n2.5,1.0\n");
  World world;
  world.particles.fields.resize(1);
  Particles& p = world.particles;
  p.rho[0] = rho0, p.E[0] = 2.5, p.p[0] = 1;
  p.active = p.moving = 1;
  const auto pass = pass_of(law, rho0, -1e20, world);
  Clock clock;
  clock.dt_old = 1e-3;
  for (int k = 0; k < 1000; ++k) {
    p.drhodt[0] = 1.0;
    courant::test::run(*pass, world, clock);
  }
  EXPECT_NEAR(p.rho[0], 2, 1e-12);
  EXPECT_NEAR(p.p[0], std::pow(2.0, gamma), 2e-6);
  EXPECT_NEAR(p.c[0], std::sqrt(gamma * p.p[0] / p.rho[0]), 1e-9);
}

// In along C to ln V = -0.3, where p = 5.5, out along K = 30 to p = 0 and in again; work into E, with a law
// that uses it and without.
TEST(EquationOfState, WhatWasCrushedComesBackAlongItsModulus) {
  for (const char* gama : {"0.0", "1e-30"}) {
    const auto law =
        law_of("EOS_TABULATED_COMPACTION", std::string("1,") + gama +
                                               "\n0.0,-0.1,-0.5\n\n0.0,1.0,10.0\n\n1.0,1.0,1.0\n\n"
                                               "20.0,20.0,40.0\n\n");
    World world;
    Particles& p = world.particles;
    p.fields.resize(1);
    p.rho[0] = 2, p.active = p.moving = 1;
    const auto pass = pass_of(law, 2, -1e20, world);
    Clock clock;
    clock.dt_old = 1;
    const auto go_to = [&](Real eV) {
      const Real from = std::log(2 / p.rho[0]);
      constexpr int steps = 1000;
      for (int k = 1; k <= steps; ++k) {
        p.drhodt[0] = 2 * std::exp(-from - (eV - from) * k / steps) - p.rho[0];
        courant::test::run(*pass, world, clock);
      }
    };
    go_to(-0.3);
    EXPECT_NEAR(p.p[0], 5.5, 1e-9);
    EXPECT_NEAR(p.c[0], std::sqrt(30 / p.rho[0]), 1e-9);
    // -int p dv with s = -ln v: of p = 10 s, and of 1 + 22.5 (s - 0.1)
    const Real a = std::exp(-0.1), b = std::exp(-0.3), taken = p.E[0];
    EXPECT_NEAR(taken, 10 * (1 - 1.1 * a) + (1 + 22.5) * a - (5.5 + 22.5) * b, 1e-5);
    go_to(-0.3 + 5.5 / 30);
    EXPECT_NEAR(p.p[0], 0, 1e-9);
    EXPECT_NEAR(p.E[0], taken - b * (30 * std::exp(5.5 / 30) - 35.5), 1e-5);
    go_to(-0.3);
    EXPECT_NEAR(p.p[0], 5.5, 1e-9);
    EXPECT_NEAR(p.E[0], taken, 1e-5);
  }
}

TEST(EquationOfState, ViscousHeatGoesIntoTheEnergyOfALawThatUsesIt) {
  // at constant volume dE = heat dt / reference volume, p = (gamma - 1) E; both kinds of viscous heat count
  for (const bool uses : {true, false}) {
    const auto law = polynomial(uses ? 0.4 : 0.0);
    World world;
    Particles& p = world.particles;
    p.fields.resize(1);
    sph_fields::dissipation(p)[0] = 30;
    sph_fields::viscous_dissipation(p)[0] = 10;
    p.fields.add<Real>({.name = "reference_volume"})[0] = 2;
    p.rho[0] = 1, p.E[0] = 2.5;
    p.active = p.moving = 1;
    const auto pass = pass_of(law, 1.0, -1e20, world);
    Clock clock;
    clock.dt_old = 0.01;
    courant::test::run(*pass, world, clock);
    EXPECT_NEAR(p.E[0], 2.5 + (uses ? 0.2 : 0), 1e-14);
    EXPECT_NEAR(p.p[0], uses ? 0.4 * 2.7 : 0, 1e-14);
  }
}

// dE = -q dv: f acts on the velocities before the kick and behind it, half of it on either.
TEST(EquationOfState, TakesViscousHeatOfTheForcesAtBothEndsOfAStep) {
  World world;
  Particles& p = world.particles;
  p.fields.resize(2);
  p.active = p.moving = 1;
  SphSettings settings;
  const Field<Real>& heat = add_viscous_heat(settings, world);
  const auto go = [&](const Vec& v, const Vec& f, Real power) {
    p.v.set(0, v), p.f.set(0, f), sph_fields::dissipation(p)[0] = power;
    for (BlockPass* pass : world.passes.in_phase(Phase::rates, world)) courant::test::run(*pass, world, {});
    return heat[0];
  };
  EXPECT_EQ(go(Vec(3, 0, 1), Vec(2, 5, 0), 5), 2.5) << "no force before";
  // the force (2, 5, 0) took 5 from (3, 0, 1): 5 - 2 (2.5 - 3) - 5 (0.2 - 0) = 5 from what they are now
  EXPECT_EQ(go(Vec(2.5, 0.2, 7), Vec(1, 0, 0), 4), 4.5);
  EXPECT_EQ(go(Vec(2.5, 0.2, 7), Vec::Zero(), 0), 2);
  EXPECT_EQ(go(Vec(1, 1, 1), Vec::Zero(), 0), 0);
  // not where heat is that of the step before, or made of more than forces
  settings.viscosity = BulkViscosity{};
  EXPECT_EQ(&add_viscous_heat(settings, world), &sph_fields::dissipation(p));
  settings.viscosity = MonaghanViscosity{}, settings.density_diffusion = 0.1;
  EXPECT_EQ(&add_viscous_heat(settings, world), &sph_fields::dissipation(p));
}

// p = C1 mu + C4 E: without the cut-off c^2 = (C1 + C4 p/(1 + mu)^2)/rho0 is negative far out.
TEST(EquationOfState, WhereTensionIsCutOffItsWorkDoesNotSoften) {
  const auto law = polynomial_of("1,0.0,8.0,0.0,0.0,2.0\n0.0,1.0\n");
  World world;
  Particles& p = world.particles;
  p.fields.resize(2);
  p.active = p.moving = 2;
  p.rho[0] = 0.9, p.rho[1] = 0.1;
  Field<Real>& least = sph_fields::least_pressure(p);
  Clock clock;
  courant::test::run(*pass_of(law, 1, -1, world), world, clock);
  EXPECT_NEAR(p.p[0], -0.8, 1e-14);
  EXPECT_NEAR(p.c[0], std::sqrt(8 - 2 * 0.8 / 0.81), 1e-14);
  EXPECT_EQ(p.p[1], -1);
  EXPECT_NEAR(p.c[1], std::sqrt(8.0), 1e-14);
  least[0] = 0, least[1] = -5;  // spalled; and another cut-off than PC
  EosParts parts{{1}, true, {1}, {-1}};
  parts.least_pressure = &least;
  EquationOfState pass(law, parts, {}, world);
  courant::test::run(pass, world, clock);
  EXPECT_EQ(p.p[0], 0);
  EXPECT_NEAR(p.c[0], std::sqrt(8.0), 1e-14);
  EXPECT_EQ(p.p[1], -5);
  EXPECT_EQ(world.counters.count("sound_speed_clamped"), 0u);
}

TEST(EquationOfState, CutsTensionAtPcAndStopsAtNegativeDensity) {
  const auto law = polynomial(0);
  World world;
  world.particles.fields.resize(1);
  Particles& p = world.particles;
  p.rho[0] = 1000, p.id[0] = 17;
  p.active = p.moving = 1;
  const auto pass = pass_of(law, 1000, -500, world);
  Clock clock;
  clock.dt_old = 1;
  p.drhodt[0] = -100;
  courant::test::run(*pass, world, clock);
  EXPECT_DOUBLE_EQ(p.p[0], -500);
  p.drhodt[0] = -1000;
  EXPECT_THROW(
      try { courant::test::run(*pass, world, clock); } catch (const RunError& e) {
        EXPECT_NE(std::string(e.what()).find("particle 17"), std::string::npos);
        throw;
      },
      RunError);
}

TEST(EquationOfState, CountsParticlesWithoutSoundSpeed) {
  // p = C1 mu + C3 mu^3 + C4 E with C1 = 3, C3 = -1: dp/dmu = 3 - 3 mu^2 < 0 beyond mu = 1; with C4 = 1e-6 by
  // the pass that solves for the energy
  for (const std::string factor : {"0.0", "1.0E-6"}) {
    const auto law = polynomial_of("1,0.0,3.0,0.0,-1.0," + factor + "\n0.0,1.0\n");
    World world;
    Particles& p = world.particles;
    p.fields.resize(3);
    p.active = p.moving = 3;
    for (Index i = 0; i < 3; ++i) p.rho[i] = 1 + 0.6 * i;  // mu = 0, 0.6, 1.2
    const auto pass = pass_of(law, 1, -1e20, world);
    Clock clock;
    courant::test::run(*pass, world, clock);
    EXPECT_NEAR(p.c[1], std::sqrt(3 - 3 * 0.36), 1e-5) << factor;
    EXPECT_EQ(p.c[2], 0) << factor;
    EXPECT_EQ(world.counters, (Counters{{"sound_speed_clamped", 1}})) << factor;
    courant::test::run(*pass, world, clock);
    EXPECT_EQ(world.counters.at("sound_speed_clamped"), 2) << factor;
    p.rho[2] = 1.8;
    courant::test::run(*pass, world, clock);
    EXPECT_EQ(world.counters.at("sound_speed_clamped"), 2) << factor;
  }
}

TEST(EquationOfState, StopsBeyondThePoleOfItsLawAndNamesTheParticle) {
  for (const std::string gamma : {"0.0", "0.5"}) {  // without energy, and with it: two loops
    const auto law = law_of("EOS_GRUNEISEN", "1,1484.0,2.0,0.0,0.0," + gamma + "\n")->at_density(1000);
    Clock clock;
    clock.t = 0.25, clock.dt_old = 1;
    World below = particle(1000, 990), beyond = particle(1000, 1010);
    auto pass = pass_of(law, 1000, -1e20, below);
    courant::test::run(*pass, below, clock);
    EXPECT_GT(below.particles.p[0], 1e12);
    auto stops = pass_of(law, 1000, -1e20, beyond);
    try {
      courant::test::run(*stops, beyond, clock);
      FAIL() << "the density is beyond the pole";
    } catch (const RunError& e) {
      EXPECT_STREQ(e.what(),
                   "density of particle 17 of part 0 became 2010 [M/L3] at time 0.25, cycle 0, x = (0, 0, "
                   "0): its equation "
                   "of state ends at 2000, where the pressure becomes infinite");
    }
  }
}
