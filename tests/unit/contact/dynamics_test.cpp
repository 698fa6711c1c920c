#include <gtest/gtest.h>

#include "parallel/parallel.hpp"
#include "scene.hpp"

using namespace courant;
using courant::test::Scene;

namespace {

struct Random {
  std::uint64_t seed = 12345;
  Real operator()() {
    seed = seed * 6364136223846793005ull + 1442695040888963407ull;
    return Real(seed >> 11) / 9007199254740992.0;
  }
};

/// In 2D the stiffness of a shell is per unit of depth, as a particle's: the unit of length and how far a
/// plate happens to reach along z change nothing.
TEST(ContactDynamics, In2DShellsAreAsStiffWhateverTheirWidthAndTheUnitOfLength) {
  const auto step_of = [](Real width, Real unit) {
    Scene s;
    s.world.dim = 2;
    s.law.penopt = 2;
    s.K = 1e9 * unit;  // [M/LT2]
    s.m = 0.1 * unit, s.rho = 1000 * unit * unit * unit, s.c = 10 / unit;
    s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0) / unit, Vec(0, 0, width) / unit, 2, 1);
    s.x = {Vec(0.04, 0.05, 0) / unit};
    s.build();
    return s.contact->limit(s.world, s.clock).dt;
  };
  const Real dt = step_of(1, 1);
  EXPECT_NEAR(step_of(5, 1), dt, 1e-12 * dt);
  EXPECT_NEAR(step_of(1, 1e-3), dt, 1e-12 * dt);
}

/// Stable step of a particle of mass 1 at a wall of nodes of mass `wall`, 0: held; stiffness 0.1 rho c^2 dx =
/// 1000.
Real stable_step(Real wall, Real vdc) {
  Scene s;
  s.m = 1, s.rho = 1000, s.c = 10;
  s.held = wall == 0;
  s.law.vdc = vdc;
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0));
  s.x = {Vec(0.05, 0.05, 0.5)};
  s.build(wall > 0 ? wall : 1);
  return s.contact->limit(s.world, s.clock).dt;
}

/// A spring between two masses swings by their reduced one: quicker at a wall that yields.
TEST(ContactDynamics, TheStepIsThatOfTheReducedMassOfParticleAndWall) {
  EXPECT_NEAR(stable_step(0, 0), std::sqrt(2 / 1000.), 1e-12);
  EXPECT_NEAR(stable_step(1, 0), std::sqrt(1 / 1000.), 1e-12);
  EXPECT_NEAR(stable_step(0.25, 0), std::sqrt(0.4 / 1000.), 1e-12);
}

/// Velocities of the step before damp: stable for w dt < 2 (sqrt(1 + xi^2) - xi), the root of w^2 dt^2 + 4 xi
/// w dt = 4. Nine tenths of that, and no more than without damping.
TEST(ContactDynamics, DampingShortensTheStep) {
  const Real w = std::sqrt(1000.);
  for (const Real vdc : {50., 100., 300.}) {
    const Real a = w * stable_step(0, vdc) / 0.9;
    EXPECT_NEAR(a * a + 4 * 0.01 * vdc * a, 4, 1e-9) << vdc;
  }
  EXPECT_EQ(stable_step(0, 1), stable_step(0, 0));
}

TEST(ContactDynamics, BounceConservesEnergy) {
  Scene s;
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 2, 2);
  s.x = {Vec(0.04, 0.04, 0.05)};
  s.v = {Vec(0.1, 0, 0)};
  s.build();
  const Real dt = 0.1 * s.contact->limit(s.world, s.clock).dt, g = 9.81;
  Real highest = 0;
  bool down = false;
  for (int n = 0; s.clock.t < 0.30; ++n) {
    s.step(dt, Vec(0, 0, -g));
    const Real z = s.world.particles.x.vec(0).z();
    down = down || z < 0.0099;
    if (down && s.world.particles.v.vec(0).z() > 0) highest = 0;
    highest = std::max(highest, z);
  }
  EXPECT_TRUE(down);
  const Vec v = s.world.particles.v.vec(0);
  const Real energy = s.kinetic() + s.m * g * s.world.particles.x.vec(0).z();
  const Real before = 0.5 * s.m * 0.01 + s.m * g * 0.05;
  EXPECT_NEAR(energy, before, 0.01 * before);
  EXPECT_NEAR(v.x(), 0.1, 1e-12);
  EXPECT_EQ(s.world.counters.at("leaked_particles"), 0);
}

TEST(ContactDynamics, DampingDissipatesWhatTheLedgerSays) {
  Scene s;
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 2, 2);
  s.x = {Vec(0.04, 0.04, 0.012)};
  s.v = {Vec(0, 0, -0.3)};
  s.law.vdc = 30;
  s.build();
  const Real dt = 0.02 * s.contact->limit(s.world, s.clock).dt, before = s.kinetic();
  while (s.world.particles.x.vec(0).z() < 0.0121) s.step(dt);
  EXPECT_LT(s.kinetic(), 0.6 * before);
  EXPECT_NEAR(s.kinetic() + s.world.energy.dissipated, before, 0.01 * before);
  EXPECT_NEAR(s.contact->report().energy_damping, s.world.energy.dissipated, 1e-15);
}

TEST(ContactDynamics, FrictionStopsASlide) {
  Scene s;
  s.plate(Vec(-0.05, 0, 0), Vec(0.5, 0, 0), Vec(0, 0.1, 0), 50, 10);
  s.law.fs = s.law.fd = 0.3;
  const Real g = 9.81, k = 0.1 * s.rho * s.c * s.c * std::cbrt(s.m / s.rho);
  s.x = {Vec(0, 0.043, 0.01 - s.m * g / k)};
  s.v = {Vec(1, 0, 0)};
  s.build();
  const Real dt = 0.2 * s.contact->limit(s.world, s.clock).dt;
  while (s.clock.t < 0.6) s.step(dt, Vec(0, 0, -g));
  EXPECT_NEAR(s.world.particles.x.vec(0).x(), 1 / (2 * 0.3 * g), 0.01 / (2 * 0.3 * g));
  EXPECT_LT(std::abs(s.world.particles.v.vec(0).x()), 0.02);
  EXPECT_NEAR(s.contact->report().energy_friction, 0.5 * s.m, 0.02 * s.m);
}

TEST(ContactDynamics, FrictionHoldsOnAGentleSlope) {
  Scene s;
  s.plate(Vec(-0.05, 0, 0), Vec(0.5, 0, 0), Vec(0, 0.1, 0), 50, 10);
  s.law.fs = s.law.fd = 0.3;
  const Real g = 9.81, k = 0.1 * s.rho * s.c * s.c * std::cbrt(s.m / s.rho), x0 = 0.02;
  s.x = {Vec(x0, 0.043, 0.01 - s.m * g / k)};
  s.v = {Vec::Zero()};
  s.build();
  const Real dt = 0.2 * s.contact->limit(s.world, s.clock).dt;
  Real farthest = 0;
  while (s.clock.t < 0.5) {
    s.step(dt, Vec(0.1 * g, 0, -g));
    farthest = std::max(farthest, s.world.particles.x.vec(0).x() - x0);
  }
  EXPECT_GT(farthest, 1.5 * 0.1 * s.m * g / k);   // it swings about the stretch that carries it
  EXPECT_LT(farthest, 2.05 * 0.1 * s.m * g / k);  // and does not creep
}

TEST(ContactDynamics, TheLedgerHoldsWhatTheSpringStores) {
  Scene s;
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 2, 2);
  s.x = {Vec(0.04, 0.04, 0.012)};
  s.v = {Vec(0, 0, -0.3)};
  s.build();
  const Real dt = 0.01 * s.contact->limit(s.world, s.clock).dt, before = s.kinetic();
  Real most = 0;
  while (s.world.particles.x.vec(0).z() < 0.0121) {
    s.step(dt);
    EnergyLedger now;
    s.contact->sample(s.world, s.clock, now);
    most = std::max(most, now.contact);
    EXPECT_NEAR(s.kinetic() + now.contact, before, 0.03 * before);
  }
  EXPECT_NEAR(most, before, 0.01 * before);
}

TEST(ContactDynamics, NoParticleLeavesABoxOfSeparatePatches) {
  for (const int soft : {0, 1}) {
    Scene s;
    s.thickness = 0.004;
    const Real a = 0.1;
    const Vec o = Vec::Zero(), X(a, 0, 0), Y(0, a, 0), Z(0, 0, a);
    s.plate(o, X, Y, 7, 5), s.plate(Z, X, Y, 4, 9);
    s.plate(o, X, Z, 3, 8), s.plate(Y, X, Z, 6, 6);
    s.plate(o, Y, Z, 11, 2), s.plate(X, Y, Z, 5, 5);
    s.law.soft = soft;
    s.law.sofscl = 0.5;
    Random random;
    for (int i = 0; i < 400; ++i) {
      s.x.push_back(Vec(0.005 + 0.09 * random(), 0.005 + 0.09 * random(), 0.005 + 0.09 * random()));
      // up to half of the speed that takes a particle through r, many hits straight into edges and corners
      s.v.push_back(0.6 * Vec(random() - 0.5, random() - 0.5, random() - 0.5));
      if (i % 3 == 0) s.v.back() = (0.3 / a) * (Vec(i % 2, (i / 2) % 2, (i / 4) % 2) * a - s.x.back());
    }
    s.build();
    const Real dt = 0.2 * s.contact->limit(s.world, s.clock).dt, before = s.kinetic();
    while (s.clock.t < 2.0) s.step(dt);
    for (Index i = 0; i < s.world.particles.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        EXPECT_GT(s.world.particles.x.vec(i)[k], 0);
        EXPECT_LT(s.world.particles.x.vec(i)[k], a);
      }
    EXPECT_NEAR(s.kinetic() + s.contact->report().energy_stored, before, 0.02 * before) << "SOFT " << soft;
    EXPECT_EQ(s.world.counters.at("leaked_particles"), 0);
    EXPECT_GT(s.world.maxima.at("max_penetration"), 0.0005);
  }
}

// So fast that mid-surfaces are crossed all the time: each particle is counted once, and pulled back also
// from beyond edges and corners.
TEST(ContactDynamics, ParticlesBeyondTheMidSurfaceComeBack) {
  Scene s;
  s.thickness = 0.004;
  s.options.reach_margin = 0.05;
  s.law.literal = true;  // or none would get there
  const Real a = 0.1;
  const Vec o = Vec::Zero(), X(a, 0, 0), Y(0, a, 0), Z(0, 0, a);
  s.plate(o, X, Y, 7, 5), s.plate(Z, X, Y, 4, 9);
  s.plate(o, X, Z, 3, 8), s.plate(Y, X, Z, 6, 6);
  s.plate(o, Y, Z, 11, 2), s.plate(X, Y, Z, 5, 5);
  Random random;
  for (int i = 0; i < 300; ++i) {
    s.x.push_back(Vec(0.01 + 0.08 * random(), 0.01 + 0.08 * random(), 0.01 + 0.08 * random()));
    s.v.push_back(8.0 * Vec(random() - 0.5, random() - 0.5, random() - 0.5));
    if (i % 3 == 0) s.v.back() = (5.0 / a) * (Vec(i % 2, (i / 2) % 2, (i / 4) % 2) * a - s.x.back());
  }
  s.build();
  const Real dt = 0.1 * s.contact->limit(s.world, s.clock).dt, before = s.kinetic();
  Real farthest = 0;
  while (s.clock.t < 0.5) {
    s.step(dt, Vec::Zero(), 3);
    for (Index i = 0; i < s.world.particles.size(); ++i)
      farthest = std::max(farthest,
                          (s.world.particles.x.vec(i) - Vec(0.05, 0.05, 0.05)).cwiseAbs().maxCoeff() - 0.05);
  }
  EXPECT_GT(s.world.counters.at("leaked_particles"), 100);
  EXPECT_LE(s.world.counters.at("leaked_particles"), 300);
  EXPECT_GT(farthest, 0.002);
  EXPECT_LT(farthest, 0.03);
  EXPECT_NEAR(s.kinetic() + s.contact->report().energy_stored, before, 0.05 * before);
}

TEST(ContactDynamics, SameBitsOnAnyNumberOfThreads) {
  std::vector<Real> first;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    Scene s;
    s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 5, 5);
    s.law.fs = s.law.fd = 0.2;
    s.law.vdc = 10;
    Random random;
    for (int i = 0; i < 2000; ++i) {
      s.x.push_back(Vec(0.1 * random(), 0.1 * random(), 0.012));
      s.v.push_back(Vec(random(), 0, -0.5 * random()));
    }
    s.build();
    for (int k = 0; k < 50; ++k) s.step(0.1 * s.contact->limit(s.world, s.clock).dt);
    std::vector<Real> now;
    for (Index i = 0; i < s.world.particles.size(); ++i)
      for (int k = 0; k < 3; ++k) now.push_back(s.world.particles.x.vec(i)[k]);
    for (int k = 0; k < 3; ++k) now.push_back(s.contact->report().on_surfa[k]);
    if (first.empty()) first = now;
    EXPECT_TRUE(first == now) << n << " threads";
  }
  set_threads(0);
}

TEST(ContactDynamics, BirthAndDeath) {
  Scene s;
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0));
  s.x = {Vec(0.05, 0.05, 0.005)};
  s.law.birth = 1, s.law.death = 2;
  s.build();
  EXPECT_EQ(s.force(Vec(0.05, 0.05, 0.005)).norm(), 0);
  s.clock.t = 1.5;
  EXPECT_GT(s.force(Vec(0.05, 0.05, 0.005)).z(), 0);
  s.clock.t = 2.5;
  EXPECT_EQ(s.force(Vec(0.05, 0.05, 0.005)).norm(), 0);
}

TEST(ContactDynamics, PenaltyStiffnessFollowsPenopt) {
  for (const int penopt : {1, 2, 3}) {
    Scene s;
    s.K = 1e5;  // soft wall
    s.law.penopt = penopt;
    s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0));
    s.x = {Vec(0, 0, 1)};
    s.build();
    const Real k_seg = 0.1 * s.K * 0.01 / (0.1 * std::sqrt(2.0)), k_node = 0.1 * s.rho * s.c * s.c * 0.01;
    const Real k = penopt == 1 ? std::min(k_seg, k_node) : penopt == 2 ? k_seg : k_node;
    EXPECT_NEAR(s.force(Vec(0.05, 0.05, 0.005)).z(), k * 0.005, 1e-9 * k);
  }
}

TEST(ContactDynamics, InitialPenetrationsAreCounted) {
  Scene s;
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0));
  s.x = {Vec(0.05, 0.05, 0.01), Vec(0.05, 0.05, 0.008), Vec(0.05, 0.05, 0.003), Vec(0.05, 0.05, 0.05)};
  s.build();
  const auto p = s.contact->penetrations(s.world);
  EXPECT_EQ(p.count, 2);
  EXPECT_NEAR(p.deepest, 0.007, 1e-12);
  EXPECT_EQ(p.particle, 3);
}

}  // namespace

/// mu = FD + (FS - FD) exp(-DC v) of the push, and no more than the stress VC on a face of the particle.
TEST(ContactDynamics, FrictionFallsWithTheSlipAndIsBoundedByAStress) {
  for (const Real vc : {0.0, 2.0}) {
    Scene s;
    s.plate(Vec(-0.05, 0, 0), Vec(0.5, 0, 0), Vec(0, 0.1, 0), 50, 10);
    s.law.fs = 0.5, s.law.fd = 0.2, s.law.dc = 3, s.law.vc = vc;
    s.x = {Vec(0, 0.043, 0.0095)};
    s.v = {Vec(0.4, 0, 0)};
    s.build();
    s.before_move = [&] { s.world.particles.f.set(0, Vec::Zero()); };
    for (int k = 0; k < 5; ++k) {
      s.step(1e-3);
      const Vec pushed = s.contact->report().on_surfa;
      if (k < 4) continue;
      const Real most = (0.2 + 0.3 * std::exp(-3 * 0.4)) * std::abs(pushed.z()), dx = std::cbrt(s.m / s.rho);
      EXPECT_LT(vc * dx * dx, most);
      EXPECT_NEAR(std::abs(pushed.x()), vc > 0 ? vc * dx * dx : most, 1e-12);
    }
  }
}
