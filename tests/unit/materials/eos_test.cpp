#include "materials/eos.hpp"
#include "../run_pass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include <unistd.h>

#include "keyword/deck.hpp"

using namespace courant;

namespace {

/// Reads one EOS from its cards, for a material of density rho0.
std::shared_ptr<EosLaw> law_of(const EosEntry& kind, const std::string& cards, Real rho0 = 1) {
  const auto path =
      std::filesystem::temp_directory_path() / ("eos_test_" + std::to_string(::getpid()) + ".k");
  std::ofstream(path) << "*KEYWORD\n*" << kind.keyword << "\n" << cards << "*END\n";
  Diagnostics diagnostics;
  const Deck deck = read_deck(path.string(), {}, diagnostics);
  std::filesystem::remove(path);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  const auto laws = kind.all(deck);
  EXPECT_EQ(laws.size(), 1u);
  const auto law = laws.at(0).second;
  const auto of_density = law->at_density(rho0);
  return of_density ? of_density : law;
}

std::shared_ptr<EosLaw> polynomial_of(const std::string& cards) {
  for (const EosEntry& kind : eos_registry())
    if (kind.keyword == "EOS_LINEAR_POLYNOMIAL") return law_of(kind, cards);
  return nullptr;
}

/// p = factor (1 + mu) E, an ideal gas of gamma = 1 + factor; with factor 0 a liquid of bulk modulus 9e5.
std::shared_ptr<EosLaw> polynomial(Real factor) {
  return polynomial_of("1,0.0," + std::string(factor > 0 ? "0.0" : "9.0E5") + ",0.0,0.0," +
                       std::to_string(factor) + "," + std::to_string(factor) + "\n0.0,1.0\n");
}

}  // namespace

TEST(EosRegistry, HoldsTheLawsAndEachHasReferences) {
  std::set<std::string> names;
  for (const EosEntry& kind : eos_registry()) {
    names.insert(kind.keyword);
    EXPECT_FALSE(kind.references.empty()) << kind.keyword;
    EXPECT_FALSE(kind.equation.empty());
    EXPECT_FALSE(kind.source.empty());
  }
  EXPECT_TRUE(names.contains("EOS_LINEAR_POLYNOMIAL"));
  EXPECT_TRUE(names.contains("EOS_MURNAGHAN"));
  EXPECT_TRUE(names.contains("EOS_GRUNEISEN"));
  EXPECT_TRUE(names.contains("EOS_IDEAL_GAS"));
}

TEST(EosRegistry, EveryLawGivesItsReferenceValues) {
  for (const EosEntry& kind : eos_registry())
    for (const EosReference& r : kind.references)
      EXPECT_NEAR(law_of(kind, r.deck, r.rho0)->pressure(r.mu, r.E), r.p,
                  1e-12 * std::max(1.0, std::abs(r.p)))
          << kind.keyword;
}

TEST(EosRegistry, SoundSpeedIsTheSlopeOfPressureAlongAnIsentrope) {
  const Real rho0 = 3;
  for (const EosEntry& kind : eos_registry())
    for (const EosReference& r : kind.references) {
      const auto law = law_of(kind, r.deck, rho0);
      // both sides of mu: dE = -p dv with v = 1/(1 + mu)
      const Real d = 1e-6, p = law->pressure(r.mu, r.E);
      const auto along = [&](Real dmu) {
        const Real dv = 1 / (1 + r.mu + dmu) - 1 / (1 + r.mu);
        return law->pressure(r.mu + dmu, r.E - p * dv);
      };
      const Real c2 = (along(d) - along(-d)) / (2 * d) / rho0;
      const Real scale = std::max(1e-3, std::abs(c2));
      EXPECT_NEAR(law->slope(r.mu, r.E),
                  (law->pressure(r.mu + d, r.E) - law->pressure(r.mu - d, r.E)) / (2 * d),
                  1e-5 * rho0 * scale)
          << kind.keyword << " mu " << r.mu;
      if (r.mu != 0) {  // at mu = 0 the law may have a kink
        EXPECT_NEAR(law->sound_speed2(rho0, r.mu, r.E), c2, 1e-6 * scale) << kind.keyword << " mu " << r.mu;
      }
    }
}

TEST(EosPass, AnIdealGasStaysOnItsIsentrope) {
  // p v^gamma is constant when a gas is compressed step by step without heat
  const Real gamma = 1.4, rho0 = 1;
  const EosEntry* polynomial = nullptr;
  for (const EosEntry& kind : eos_registry())
    if (kind.keyword == "EOS_LINEAR_POLYNOMIAL") polynomial = &kind;
  ASSERT_NE(polynomial, nullptr);
  const auto law = law_of(*polynomial,
                          "         1       0.0       0.0       0.0       0.0       0.4       0.4       "
                          "0.0\n       2.5       1.0\n");
  World world;
  world.particles.fields.resize(1);
  Particles& p = world.particles;
  p.rho[0] = rho0, p.E[0] = 2.5, p.p[0] = 1;
  p.active = p.moving = 1;
  auto pass = law->make_pass({{1}, true, {rho0}, {-1e20}}, world);
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

TEST(EosPass, ViscousHeatGoesIntoTheEnergyOfALawThatUsesIt) {
  // at constant volume dE = heat dt / reference volume, p = (gamma - 1) E; both kinds of viscous heat count
  for (const bool uses : {true, false}) {
    const auto law = polynomial(uses ? 0.4 : 0.0);
    World world;
    Particles& p = world.particles;
    p.fields.resize(1);
    p.fields.add<Real>({.name = "dissipation"})[0] = 30;
    p.fields.add<Real>({.name = "viscous_dissipation"})[0] = 10;
    p.fields.add<Real>({.name = "reference_volume"})[0] = 2;
    p.rho[0] = 1, p.E[0] = 2.5;
    p.active = p.moving = 1;
    auto pass = law->make_pass({{1}, true, {1.0}, {-1e20}}, world);
    Clock clock;
    clock.dt_old = 0.01;
    courant::test::run(*pass, world, clock);
    EXPECT_NEAR(p.E[0], 2.5 + (uses ? 0.2 : 0), 1e-14);
    EXPECT_NEAR(p.p[0], uses ? 0.4 * 2.7 : 0, 1e-14);
  }
}

TEST(EosPass, CutsTensionAtPcAndStopsAtNegativeDensity) {
  const auto law = polynomial(0);
  World world;
  world.particles.fields.resize(1);
  Particles& p = world.particles;
  p.rho[0] = 1000, p.id[0] = 17;
  p.active = p.moving = 1;
  auto pass = law->make_pass({{1}, true, {1000}, {-500}}, world);
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

TEST(EosPass, CountsParticlesWithoutSoundSpeed) {
  // p = C1 mu + C3 mu^3 + C4 E with C1 = 3, C3 = -1: dp/dmu = 3 - 3 mu^2 < 0 beyond mu = 1; with C4 = 1e-6 by
  // the pass that solves for the energy
  for (const std::string factor : {"0.0", "1.0E-6"}) {
    const auto law = polynomial_of("1,0.0,3.0,0.0,-1.0," + factor + "\n0.0,1.0\n");
    World world;
    Particles& p = world.particles;
    p.fields.resize(3);
    p.active = p.moving = 3;
    for (Index i = 0; i < 3; ++i) p.rho[i] = 1 + 0.6 * i;  // mu = 0, 0.6, 1.2
    auto pass = law->make_pass({{1}, true, {1}, {-1e20}}, world);
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
