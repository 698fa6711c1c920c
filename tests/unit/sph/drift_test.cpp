// Shifting and XSPH: what they even out, what they leave alone, and what the ledger says.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "../app/small_scene.hpp"
#include "../run_pass.hpp"
#include "parallel/parallel.hpp"
#include "sph/core/fields.hpp"
#include "sph/options/drift.hpp"

namespace courant {

namespace {

using test::run;
using test::steps;

const std::string everywhere =
    "*DEFINE_VECTOR\n1,0,0,0,1,0,0\n2,1,0,0,0,0,0\n3,0,0,0,0,1,0\n4,0,1,0,0,0,0\n"
    "*BOUNDARY_SPH_PERIODIC\n1,2\n3,4\n";
const std::string tank_cards = std::string(test::gravity_cards) +
                               "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,0,1,0\n0,0,0,1,0,0\n1,0,0,0,0,0\n";

/// 10 x 10 particles about 0.1 apart, each moved by up to `disorder`, all with velocity 1 along x and y.
std::string cloud(Real disorder, bool shift, const std::string& more, const char* start = "1.,1.,0.",
                  const char* timestep = "") {
  test::SmallScene scene;
  scene.timestep = timestep;
  scene.n = 0;
  scene.start = start;
  if (shift) scene.control_sph = test::shifting_cards;
  scene.extra = more + "*NODE\n";
  std::string elements = "*ELEMENT_SPH\n";
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> shake(-disorder, disorder);
  for (int k = 0; k < 100; ++k) {
    const Real dx = shake(random), dy = shake(random);
    scene.extra +=
        fmt::format("{},{:.17g},{:.17g},0\n", k + 1, 0.1 * (k % 10) + 0.05 + dx, 0.1 * (k / 10) + 0.05 + dy);
    elements += fmt::format("{},1,10.\n", k + 1);
  }
  scene.extra += elements;
  std::string text = scene.text();
  const std::string none = "*NODE\n*ELEMENT_SPH\n";
  text.erase(text.find(none), none.size());
  return text;
}

/// Mean square of the gradient of concentration
Real disorder(Simulation& s) {
  const Particles& p = s.world().particles;
  Real sum = 0;
  for (Index i = 0; i < p.active; ++i) {
    Vec slope = Vec::Zero();
    for (const Index j : s.neighbours().of(p, i)) {
      const Vec d = p.x.vec(i) - p.x.vec(j);
      const Real a = std::max(2 - d.norm() / p.h[i], Real(0));
      slope += a * a * d.normalized();
    }
    sum += slope.squaredNorm() / p.active;
  }
  return sum;
}

TEST(Shifting, EvensOutDisorder) {
  const std::string cards = everywhere + "*COURANT_SHIFTING\n4.\n";
  const auto with = test::build_deck(cloud(0.02, true, cards));
  const auto without = test::build_deck(cloud(0.02, false, everywhere));
  steps(*with, 1), steps(*without, 1);
  EXPECT_NEAR(disorder(*with), disorder(*without),
              1e-3 * disorder(*without));  // not before it knows surfaces
  steps(*with, 150), steps(*without, 150);
  EXPECT_LT(disorder(*with), 0.7 * disorder(*without));
  EXPECT_GT(with->world().maxima.at("shift_largest"), 1e-3);
}

TEST(Shifting, LeavesALatticeAlone) {
  const auto s = test::build_deck(cloud(0, true, everywhere));
  steps(*s, 50);
  EXPECT_LT(s->world().maxima.at("shift_largest"), 1e-10);
  EXPECT_NEAR(s->world().maxima.at("shift_volume_drift"), 0, 1e-10);
}

TEST(Shifting, LeavesSurfacesAlone) {
  const auto s = test::build_deck(cloud(0.005, true, ""));
  steps(*s, 3);
  Particles& p = s->world().particles;
  const Field<Real>& shift = drift_velocity(p, shift_statistics);
  const Vec middle(0.5 + s->clock().t, 0.5 + s->clock().t, 0);
  Real inside = 0;
  for (Index i = 0; i < p.active; ++i) {
    const int column = static_cast<int>(p.id[i] - 1) % 10, row = static_cast<int>(p.id[i] - 1) / 10;
    const int edge = std::min({column, row, 9 - column, 9 - row});
    if (edge == 0) EXPECT_EQ(shift.vec(i).norm(), 0) << p.id[i];
    if (edge > 3) inside = std::max(inside, shift.vec(i).norm());
    const bool corner = std::min(column, 9 - column) < 3 && std::min(row, 9 - row) < 3;
    if (edge == 1 && !corner) {  // not along the normal, which disorder turns a little
      const bool side = std::min(column, 9 - column) == 1;
      EXPECT_LT(std::abs(shift.vec(i)[side ? 0 : 1]), 0.3 * shift.vec(i).norm() + 1e-3) << p.id[i];
    }
  }
  EXPECT_GT(inside, 1e-3);
}

TEST(Shifting, WaterAtRestStaysSo) {
  const auto with = test::build_deck(cloud(0, true, tank_cards, "0.,0.,0."));
  const auto without = test::build_deck(cloud(0, false, tank_cards, "0.,0.,0."));
  run(*with, 5), run(*without, 5);
  const auto height = [](const Simulation& s) {
    const Particles& p = s.world().particles;
    return sum(p.active, [&](Index i) { return p.x.vec(i)[1]; }) / static_cast<Real>(p.active);
  };
  EXPECT_NEAR(height(*with), height(*without), 0.001);
  const EnergyLedger e = with->sample("").energy;
  EXPECT_LT(e.kinetic, 1.2 * without->sample("").energy.kinetic);
  EXPECT_LT(std::abs(with->world().maxima.at("shift_potential_energy")), 1e-3 * 1000 * 9.81 * 0.5);
}

/// What the ledger of the same flow without drift does not account for
Real residual_without() {
  const auto s = test::build_deck(cloud(0.01, false, tank_cards, "1.,0.,0."));
  run(*s, 1.5);
  return s->sample("").energy.residual();
}

TEST(Shifting, EnergyIsKept) {
  const Real without = residual_without();
  for (const char* correct : {"0", "1"}) {
    const auto s = test::build_deck(
        cloud(0.01, true, tank_cards + "*COURANT_SHIFTING\n2.,0.,0.," + correct + "\n", "1.,0.,0."));
    run(*s, 1.5);  // sloshes against the walls
    const EnergyLedger e = s->sample("").energy;
    EXPECT_LT(std::abs(e.residual()), std::abs(without) + 0.01 * e.throughput) << correct;
    EXPECT_NE(s->world().maxima.at("shift_potential_energy"), 0);
  }
}

/// One particle of mass 2 and density 1000.
void make_particle(World& world) {
  Particles& p = world.particles;
  p.fields.resize(1);
  p.active = p.moving = 1;
  p.id[0] = 1, p.m[0] = 2, p.rho[0] = 1000, p.h[0] = 0.1;
  p.x.set(0, {0.3, 0.4, 0});
  p.v.set(0, {3, 0, 0});
}

/// The energy that a drift by 0.01 x (0.2, 0.5) takes out of what the ledger calls dissipated, with velocity
/// gradients where `correct`.
Real taken_by_drift(bool correct, Real g) {
  World world;
  make_particle(world);
  Particles& p = world.particles;
  const BodyLoad gravity{.direction = Vec::UnitY(), .curve = {1, {0, 1}, {g, g}}};  // a = -g e_y
  Drift drift({.name = "shifting", .statistics = shift_statistics, .correct = correct}, {},
              BodyAcceleration({gravity}), world);
  drift_velocity(p, shift_statistics).set(0, {0.2, 0.5, 0});
  if (correct) sph_fields::velocity_gradient(p, 0).set(0, {10, 20, 0});
  test::run(drift, world, {.t = 0.5, .dt = 0.01, .dt_old = 0.01});
  EXPECT_NEAR(p.x.vec(0)[1], 0.405, 1e-15);
  EXPECT_NEAR(p.v.vec(0)[0], correct ? 3 + 10 * 0.002 + 20 * 0.005 : 3, 1e-14);
  EXPECT_GT(world.energy.throughput, 0);
  return -world.energy.dissipated;
}

// Who drifts upwards gains potential energy, and who takes the velocity of a quicker place kinetic energy,
// out of nothing: so that the balance stays, the ledger has dissipated so much less.
TEST(Drift, GainsOfPotentialAndKineticEnergyAreDissipationLess) {
  EXPECT_NEAR(taken_by_drift(false, 9.81), 2 * 9.81 * 0.005, 1e-13);
  EXPECT_NEAR(taken_by_drift(true, 0), 0.5 * 2 * (3.12 * 3.12 - 9), 1e-13);
  EXPECT_NEAR(taken_by_drift(true, 9.81), 2 * 9.81 * 0.005 + 0.5 * 2 * (3.12 * 3.12 - 9), 1e-13);
}

// Shifting and XSPH change densities against pressure: internal energy grows by p dV, out of nothing as well.
TEST(Drift, GainsOfInternalEnergyAreDissipationLess) {
  World world;
  make_particle(world);
  Particles& p = world.particles;
  DriftDensity density(world);
  const Clock clock{.t = 0.5, .dt = 0.01, .dt_old = 0.01};
  const Real rate = 50;  // of the density, by drift alone, over the whole step
  sph_fields::drift_rate(p)[0] = rate;
  p.p[0] = 2e4;
  p.drhodt[0] = 0;
  density.add(p, 0, 1);
  EXPECT_EQ(p.drhodt[0], rate);
  p.rho[0] += rate * clock.dt_old, p.p[0] = 2.2e4;
  test::run(density, world, clock);
  EnergyLedger ledger;
  density.record(world, clock, ledger);
  const Real dV = 2 / 1000.5 - 2 / 1000.;  // < 0: pressed together
  EXPECT_NEAR(ledger.dissipated, 2.1e4 * dV, 1e-9 * 2.1e4 * std::abs(dV));
  EXPECT_NEAR(ledger.throughput, 2.1e4 * std::abs(dV), 1e-9 * 2.1e4 * std::abs(dV));
}

TEST(Shifting, LeavesHeldDrivenAndTouchingParticlesAlone) {
  test::SmallScene scene;
  scene.n = 10;
  scene.start = "1.,0.,0.";
  scene.control_sph = test::shifting_cards;
  scene.extra = test::gravity_cards + test::floor_cards() +
                "*SET_NODE_LIST\n1\n45\n*BOUNDARY_SPC_SET\n1,0,0,1\n"
                "*BOUNDARY_PRESCRIBED_MOTION_NODE\n56,2,0,7\n*DEFINE_CURVE\n7\n0.,0.\n9.,0.\n";
  const auto s = test::build(scene);
  steps(*s, 100);
  Particles& p = s->world().particles;
  const Field<Real>& drifted = sph_fields::drifted(p);
  Real others = 0;
  for (Index i = 0; i < p.active; ++i) {
    if (p.id[i] == 45) EXPECT_EQ(p.x.vec(i)[1], 0.45);
    if (p.id[i] == 56) EXPECT_EQ(drifted.vec(i).norm(), 0);
    if (p.id[i] <= 10) EXPECT_EQ(drifted.vec(i).norm(), 0);
    others = std::max(others, drifted.vec(i).norm());
  }
  EXPECT_GT(others, 0);
}

TEST(Xsph, ConservesMomentumOfPlaces) {
  const auto s = test::build_deck(cloud(0.02, false, "*COURANT_XSPH\n0.5\n"));
  Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i) p.v.set(i, {std::sin(double(p.id[i])), 0.1 * double(p.id[i] % 7), 0});
  steps(*s, 3);
  const Field<Real>& u = drift_velocity(p, xsph_statistics);
  Vec total = Vec::Zero();
  Real size = 0;
  for (Index i = 0; i < p.active; ++i) total += p.m[i] * u.vec(i), size += p.m[i] * u.vec(i).norm();
  EXPECT_GT(size, 10);
  EXPECT_LT(total.norm(), 1e-12 * size);
}

TEST(Xsph, LeavesUniformFlowAlone) {
  const auto s = test::build_deck(cloud(0.0, false, everywhere + "*COURANT_XSPH\n0.5\n"));
  steps(*s, 20);
  EXPECT_LT(s->world().maxima.at("xsph_largest"), 1e-10);
}

TEST(Xsph, EnergyIsKept) {
  const auto s = test::build_deck(cloud(0.01, false, tank_cards + "*COURANT_XSPH\n0.5\n", "1.,0.,0."));
  run(*s, 1.5);
  const EnergyLedger e = s->sample("").energy;
  EXPECT_LT(std::abs(e.residual()), std::abs(residual_without()) + 0.01 * e.throughput);
}

/// Of the cubic spline: what one smoothing leaves of a wave of that number, sum_j V_j W_ij cos(k x_ij) on the
/// lattice.
Real smoothed_share(Real k, Real dx, Real h) {
  Real sum = 0;
  for (int a = -9; a <= 9; ++a)
    for (int b = -9; b <= 9; ++b) {
      const Real q = dx * std::hypot(a, b) / h;
      const Real W = q < 1 ? 1 - 1.5 * q * q + 0.75 * q * q * q : q < 2 ? 0.25 * std::pow(2 - q, 3) : 0;
      sum += dx * dx * 10 / (7 * std::numbers::pi * h * h) * W * std::cos(k * dx * a);
    }
  return sum;
}

/// What a shear wave v_y = sin(k x) keeps of itself in 50 steps.
Real kept_of_shear_wave(Real k, const std::string& cards) {
  const auto s = test::build_deck(cloud(0.0, false, everywhere + cards));
  Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i) p.v.set(i, {0, 1e-4 * std::sin(k * p.x.vec(i)[0]), 0});
  const auto energy = [&] {
    Real sum = 0;
    for (Index i = 0; i < p.active; ++i) sum += p.v.vec(i).squaredNorm();
    return sum;
  };
  steps(*s, 2);  // the first smooths nothing: no step was before it
  const Real before = energy();
  steps(*s, 50);
  return std::sqrt(energy() / before);
}

// It loses EPS (1 - its smoothed share) in each step, beside what the other viscosity of the scene takes.
TEST(VelocitySmoothing, ShearWavesDecayAsTheKernelHasIt) {
  const Real k = 2 * std::numbers::pi, h = test::build_deck(cloud(0.0, false, ""))->world().particles.h[0];
  const Real filling = smoothed_share(0, 0.1, h), share = smoothed_share(k, 0.1, h);
  const Real without = kept_of_shear_wave(k, "");
  for (const Real eps : {0.02, 0.1})
    for (const int normed : {0, 1}) {
      const Real lost = eps * (normed ? 1 - share / filling : filling - share);
      const Real kept = kept_of_shear_wave(k, fmt::format("*COURANT_XSPH\n{},{},1\n", eps, normed));
      EXPECT_NEAR(std::log(kept / without), 50 * std::log(1 - lost), 0.03 * 50 * lost)
          << eps << " " << normed;
    }
}

TEST(VelocitySmoothing, KeepsMomentumAndTellsItsHeat) {
  const auto of = [](const std::string& cards) {
    const auto s = test::build_deck(cloud(0.02, false, everywhere + cards));
    Particles& p = s->world().particles;
    steps(*s, 1);
    for (Index i = 0; i < p.size(); ++i)
      p.v.set(i, {0.1 * std::sin(double(p.id[i])), 0.01 * double(p.id[i] % 7), 0});
    const auto momentum = [&] {
      Vec sum = Vec::Zero();
      for (Index i = 0; i < p.active; ++i) sum += p.m[i] * p.v.vec(i);
      return sum;
    };
    const Vec before = momentum();
    steps(*s, 1);
    const EnergyLedger first = s->sample("").energy;
    steps(*s, 10);
    EXPECT_LT((momentum() - before).norm(), 1e-11 * before.norm());
    return (s->sample("").energy.residual() - first.residual()) / first.kinetic;
  };
  EXPECT_LT(std::abs(of("*COURANT_XSPH\n0.02,0,1\n") - of("")), 0.01);
}

// What goes in a step does not hang on how long that is.
TEST(VelocitySmoothing, BearsStepsThatGrow) {
  const auto kept = [](const char* timestep) {
    const auto s =
        test::build_deck(cloud(0.0, false, everywhere + "*COURANT_XSPH\n0.02,1,1\n", "1.,1.,0.", timestep));
    Particles& p = s->world().particles;
    const Real k = 2 * std::numbers::pi;
    for (Index i = 0; i < p.size(); ++i) p.v.set(i, {0, 1e-4 * std::sin(k * p.x.vec(i)[0]), 0});
    steps(*s, 20);
    Real sum = 0;
    for (Index i = 0; i < p.active; ++i) sum += p.v.vec(i).squaredNorm();
    return std::sqrt(sum);
  };
  EXPECT_NEAR(kept("1.E-9") / kept("0."), 1, 0.02);
}

// Water flows along a column of held particles: nothing but shear.
TEST(VelocitySmoothing, LeavesHeldParticlesAndTheirEnergyAlone) {
  std::string held = "*BOUNDARY_SPC_NODE\n";
  for (int k = 0; k < 10; ++k) held += fmt::format("{},0,1,1,1\n", 10 * k + 1);
  const auto s =
      test::build_deck(cloud(0.0, false, everywhere + held + "*COURANT_XSPH\n0.1,1,1\n", "0.,0.,0."));
  Particles& p = s->world().particles;
  steps(*s, 1);
  for (Index i = 0; i < p.active; ++i)
    if (p.id[i] % 10 != 1) p.v.set(i, {0, 1e-3, 0});
  const EnergyLedger first = s->sample("").energy;
  steps(*s, 20);
  for (Index i = 0; i < p.active; ++i)
    if (p.id[i] % 10 == 1) EXPECT_EQ(p.v.vec(i).norm(), 0);
  const EnergyLedger last = s->sample("").energy;
  EXPECT_LT(last.kinetic, 0.9 * first.kinetic);
  EXPECT_NEAR(last.residual(), first.residual(), 0.001 * first.kinetic);
}

TEST(VelocitySmoothing, LeavesUniformFlowAlone) {
  const auto a = test::build_deck(cloud(0.0, false, everywhere + "*COURANT_XSPH\n0.02,1,1\n"));
  const auto b = test::build_deck(cloud(0.0, false, everywhere));
  steps(*a, 20), steps(*b, 20);
  for (Index i = 0; i < 100; ++i)
    EXPECT_LT((a->world().particles.v.vec(i) - b->world().particles.v.vec(i)).norm(), 1e-10);
}

TEST(Xsph, WithoutStrengthIsNotThere) {
  const auto a = test::build_deck(cloud(0.02, false, "*COURANT_XSPH\n0.\n"));
  const auto b = test::build_deck(cloud(0.02, false, ""));
  steps(*a, 20), steps(*b, 20);
  for (Index i = 0; i < 100; ++i) EXPECT_EQ(a->world().particles.x.vec(i), b->world().particles.x.vec(i));
}

TEST(Drift, HasTheSameBitsOnAnyNumberOfThreads) {
  std::vector<Real> reference;
  for (const int n : {1, 2, 3}) {
    set_threads(n);
    test::SmallScene scene;
    scene.n = 24;
    scene.start = "1.5,-1.,0.";
    scene.control_sph = test::shifting_cards;
    scene.extra = test::gravity_cards + test::floor_cards() +
                  "*COURANT_SHIFTING\n2.,0.,0.,1\n*COURANT_XSPH\n0.5\n"
                  "*BOUNDARY_SPH_SYMMETRY_PLANE\n2.5,0,0,-1,0,0\n";
    const auto s = test::build(scene);
    steps(*s, 200);
    const Particles& p = s->world().particles;
    std::vector<Real> state{s->sample("").energy.total(), s->world().maxima.at("shift_volume_drift"),
                            s->world().maxima.at("shift_potential_energy")};
    for (const auto* f : {&p.x, &p.v})
      for (int k = 0; k < 3; ++k) state.insert(state.end(), f->data(k), f->data(k) + p.size());
    if (reference.empty()) reference = state;
    EXPECT_TRUE(reference == state) << n << " threads";
  }
  set_threads(0);
}

TEST(Drift, WorksInSpaceBesideAnInflowBox) {
  test::SmallScene scene;
  scene.dim = 3, scene.n = 8;
  scene.start = "2.,0.3,0.";
  scene.box = "1";
  scene.control_sph = test::shifting_cards;
  scene.extra = "*DEFINE_BOX\n1,0.2,1.4,-1.,5.,-1.,5.\n*COURANT_SHIFTING\n2.,0.,0.,1\n*COURANT_XSPH\n0.5\n";
  const auto s = test::build(scene);
  run(*s, 0.25);
  const EnergyLedger e = s->sample("").energy;
  EXPECT_TRUE(std::isfinite(e.total()));
  EXPECT_LT(std::abs(e.residual()), 0.01 * e.throughput);
}

}  // namespace

}  // namespace courant
