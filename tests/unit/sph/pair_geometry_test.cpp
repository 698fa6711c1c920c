// *COURANT_PAIR_GEOMETRY: gradients kept over several steps.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "cloud.hpp"
#include "liquid.hpp"
#include "loads/point_motion.hpp"
#include "sph/core/fields.hpp"
#include "sph/options/frozen_pairs.hpp"
#include "time/step.hpp"

using namespace courant;
using courant::test::Cloud;
using courant::test::ConstantStep;
using courant::test::liquid_pass;

namespace {

struct Result {
  std::map<Id, Vec> x;
  Real drift, residual;  ///< of momentum and energy, relative
};

/// A square of water that turns and spreads, at 1 m/s, for 8 ms.
Result run(Real eps, int threads = 1) {
  set_threads(threads);
  Cloud cloud(2, 24, 0.01, 0.1);
  World& w = cloud.world;
  Particles& p = w.particles;
  cloud.settings.geometry_eps = eps;
  Vec momentum = Vec::Zero();
  Real scale = 0;
  for (Index i = 0; i < p.size(); ++i) {
    const Vec d = (p.x.vec(i) - Vec(0.115, 0.115, 0)) / 0.115;
    p.v.set(i, Vec(-d[1], d[0], 0) + 0.2 * Vec(d[0] * d[1], 0.3, 0));
    p.c[i] = 300;
    momentum += p.m[i] * p.v.vec(i);
    scale += p.m[i] * p.v.vec(i).norm();
  }
  w.passes.add(liquid_pass(9e7, w));
  w.passes.add(make_clear_forces(points_of(w.particles)));
  w.passes.add(make_point_motion(points_of(w.particles)));
  w.passes.add(make_kinetic_energy(points_of(w.particles)));
  add_sph_passes(w, cloud.settings, cloud.neighbours, nullptr);
  w.passes.add(std::make_shared<ConstantStep>(2e-6));
  cloud.refresh();
  sample_energy(w, cloud.clock);
  w.energy.initial = w.energy.kinetic;
  PassTimer timer;
  Stepper stepper(w, cloud.neighbours.get(), {}, timer);
  for (int k = 0; k < 4000; ++k) stepper.step(cloud.clock, [](World&, const Clock&, const std::string&) {});
  sample_energy(w, cloud.clock);
  Result out;
  for (Index i = 0; i < p.size(); ++i) {
    out.x[p.id[i]] = p.x.vec(i);
    momentum -= p.m[i] * p.v.vec(i);
  }
  out.drift = momentum.norm() / scale;
  out.residual = std::abs(w.energy.residual()) / w.energy.initial;
  set_threads(0);
  return out;
}

Real distance(const Result& a, const Result& b) {
  Real sum = 0;
  for (const auto& [id, x] : a.x) sum += (x - b.x.at(id)).squaredNorm();
  return std::sqrt(sum / static_cast<Real>(a.x.size()));
}

}  // namespace

TEST(PairGeometry, FrozenGradientsConserveAndTheirErrorGoesWithTheSquareOfEps) {
  const Result exact = run(0), fine = run(0.02), coarse = run(0.08);
  for (const Result& r : {exact, fine, coarse}) {
    EXPECT_LT(r.drift, 1e-12);
    EXPECT_LT(r.residual, 2e-6);
  }
  const Real travelled = 4000 * 2e-6;  // at 1 m/s
  EXPECT_GT(distance(exact, fine), 0);
  EXPECT_LT(distance(exact, fine), 1e-5 * travelled);
  EXPECT_LT(distance(exact, coarse), 1e-4 * travelled);
  EXPECT_GT(distance(exact, coarse), 6 * distance(exact, fine));  // 4 would be the first order
}

TEST(PairGeometry, WindowLastsUntilTheFastestMayHaveMovedHalfOfEps) {
  Window window(0.02);
  const Real h = 0.1, dt = 1e-4, v = 0.95;  // EPS h/2 = 10.5 v dt: the eleventh step passes the bound
  ASSERT_TRUE(window.open(h, dt, 1));
  EXPECT_EQ(window.ahead(), 0);  // no step yet states how fast particles are
  for (int turn = 0; turn < 2; ++turn) {
    for (int k = 0; k < 10; ++k) {
      window.moved(v, h, dt);
      EXPECT_TRUE(window.is_open());
      EXPECT_FALSE(window.open(h, dt, 1));
    }
    window.moved(v, h, dt);
    EXPECT_FALSE(window.is_open());
    EXPECT_TRUE(window.open(h, dt, 1));
    // rates hold at -1/2 to 9 1/2 steps from now, forces at 0 to 10
    EXPECT_NEAR(window.ahead(), (0.5 * 10 - 0.25) * dt, 1e-12 * dt);
  }
  window.close();  // lists that hold for four steps more
  EXPECT_TRUE(window.open(h, dt, 4.5 * v * dt));
  EXPECT_NEAR(window.ahead(), (0.5 * 4 - 0.25) * dt, 1e-12 * dt);
}

TEST(PairGeometry, FrozenGradientsGiveTheSameBitsOnAnyNumberOfThreads) {
  EXPECT_EQ(run(0.01, 1).x, run(0.01, 2).x);
}

TEST(PairGeometry, AWindowEndsWhereParticlesDriftAsWhereTheyMove) {
  for (const Real drift : {0.0, 1.0}) {
    Cloud cloud(2, 8, 0.01, 0.1);
    World& w = cloud.world;
    Particles& p = w.particles;
    cloud.settings.geometry_eps = 0.1, cloud.settings.xsph = 0.5;
    cloud.make_frozen_pairs();
    cloud.refresh();
    for (Index i = 0; i < p.size(); ++i) sph_fields::drifted(p).set(i, Vec(0, drift, 0));
    cloud.clock.dt = cloud.clock.dt_old = 2e-4;  // three steps at 1 m/s are half of EPS h
    cloud.run_rates();
    for (int k = 0; k < 4; ++k)
      for (BlockPass* pass : w.passes.in_phase(Phase::preparation, w)) cloud.run(*pass);
    cloud.run_rates();
    EXPECT_EQ(w.counters.at("pair_geometry_windows"), drift > 0 ? 2 : 1) << drift;
  }
}
