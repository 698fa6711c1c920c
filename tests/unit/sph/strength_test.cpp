// Particles with strength: spin, stress that turns with the body, energy, artificial stress, what is refused.
#include "sph/materials/strength.hpp"
#include "../laws/law_from_cards.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cloud.hpp"
#include "laws/strength/strength.hpp"
#include "liquid.hpp"
#include "loads/point_motion.hpp"
#include "sph/core/fields.hpp"
#include "time/step.hpp"

using namespace courant;
using courant::test::Cloud;
using courant::test::ConstantStep;

namespace {

constexpr Real K = 9e5, G = 3e5;

std::shared_ptr<StrengthLaw> rubber() {
  return test::law_from_cards("MAT_ELASTIC", fmt::format("1,1000.0,{},{}\n", 9 * K * G / (3 * K + G),
                                                         (3 * K - 2 * G) / (6 * K + 2 * G)));
}

BlockPass& pass_of(World& w, Phase phase, const std::string& name) {
  for (BlockPass* pass : w.passes.in_phase(phase, w))
    if (pass->name() == name) return *pass;
  throw std::logic_error("no pass " + name);
}

/// A cloud of rubber with all passes of a step.
struct Rubber : Cloud {
  Rubber(int dim, int n, Real jitter = 0) : Cloud(dim, n, 0.01, jitter, 1.3) {
    settings.strength = {rubber()};
    settings.spacing_of_part = {0.01};
  }
  void add(Real eps = 0) {
    settings.artificial_stress.eps = eps;
    add_sph_passes(world, settings, neighbours, nullptr);
    world.passes.add(make_clear_forces(points_of(world.particles)));
    world.passes.add(make_point_motion(points_of(world.particles)));
    world.passes.add(make_kinetic_energy(points_of(world.particles)));
  }
};

}  // namespace

TEST(Spin, IsHalfTheCurlOfTheVelocity) {
  for (const int dim : {2, 3})
    for (const KernelChoice kernel : every_kernel) {
      Rubber cloud(dim, dim == 2 ? 15 : 11);
      cloud.settings.kernel = kernel;
      cloud.neighbours = std::make_shared<Neighbours>(0.0025, std::nullopt, kernel_support(kernel));
      Particles& p = cloud.world.particles;
      const Vec w(dim == 3 ? 1 : 0, dim == 3 ? -2 : 0, 3);
      for (Index i = 0; i < p.size(); ++i) {
        Vec v = w.cross(p.x.vec(i)) + 0.5 * p.x.vec(i);  // and a divergence, which it does not see
        if (dim == 2) v[2] = 0;
        p.v.set(i, v);
      }
      cloud.add();
      cloud.refresh();
      cloud.run(pass_of(cloud.world, Phase::rates, "spin"));
      const Vec middle = Vec(0.005, 0.005, dim == 3 ? 0.005 : 0) * (dim == 2 ? 14 : 10);
      Real nearest = 1;
      Index i = 0;
      for (Index k = 0; k < p.size(); ++k)
        if ((p.x.vec(k) - middle).norm() < nearest) nearest = (p.x.vec(i = k) - middle).norm();
      const Vec spin = sph_fields::spin(p).vec(i);
      EXPECT_LT((spin - w).norm(), 0.06 * w.norm()) << dim << " " << kernel_name(kernel);
    }
}

TEST(Strength, StressTurnsWithTheBodyForAHundredTurns) {
  // A particle that turns by an angle a step: of the positions at the end of the step its velocities have the
  // gradient (1 - R^T)/dt, whose symmetric part is not 0.
  Rubber cloud(2, 2);
  World& w = cloud.world;
  Particles& p = w.particles;
  cloud.add();
  cloud.refresh();
  const int steps = 400;
  const Real dt = 1e-3, angle = 2 * pi / steps;
  cloud.clock.dt_old = dt;
  Field<Real>&rate = sph_fields::strain_rate(p), &kept = sph_fields::law_stress(p);
  Matrix sigma;
  sigma << 100, 30, 0, 30, -50, 0, 0, 0, 20;
  for (Index i = 0; i < p.size(); ++i) {
    kept.set_tensor(i, sigma);
    rate.set_tensor(i, Vec(1, 1, 0).asDiagonal() * Matrix::Identity() * ((1 - std::cos(angle)) / dt));
    sph_fields::spin(p).set(i, Vec(0, 0, std::sin(angle) / dt));
  }
  BlockPass& pass = pass_of(w, Phase::laws, "strength");
  for (int k = 0; k < 100 * steps; ++k) cloud.run(pass);
  EXPECT_LT((kept.tensor(0) - sigma).norm(), 1e-8 * sigma.norm());
  EXPECT_NEAR(p.p[0], -70.0 / 3, 1e-8);
  EXPECT_NEAR(p.E[0], 0, 1e-8);
  for (int k = 0; k < steps / 4; ++k) cloud.run(pass);  // and a quarter of a turn
  cloud.run(pass_of(w, Phase::laws, "strength (deviator)"));
  Matrix turned;
  turned << -50, -30, 0, -30, 100, 0, 0, 0, 20;
  EXPECT_LT((kept.tensor(0) - turned).norm(), 1e-8 * sigma.norm());
  EXPECT_LT((sph_fields::stress(p).tensor(0) - p.p[0] * Matrix::Identity() - turned).norm(),
            1e-8 * sigma.norm());
}

TEST(Strength, UniaxialStrainHasTheModulusOfCompressionWaves) {
  Rubber cloud(3, 2);
  World& w = cloud.world;
  Particles& p = w.particles;
  cloud.add();
  cloud.refresh();
  EXPECT_NEAR(p.c[0], std::sqrt((K + 4 * G / 3) / 1000), 1e-9);
  const Real dt = 1e-6, e = -1;  // rate of strain along x
  cloud.clock.dt_old = dt;
  for (Index i = 0; i < p.size(); ++i) {
    p.drhodt[i] = -1000 * e;
    sph_fields::strain_rate(p).set_tensor(i, Vec(e, 0, 0).asDiagonal() * Matrix::Identity());
  }
  cloud.run(pass_of(w, Phase::laws, "strength"));
  const Matrix sigma = sph_fields::law_stress(p).tensor(0);
  EXPECT_NEAR(sigma(0, 0), (K + 4 * G / 3) * e * dt, 1e-5);
  EXPECT_NEAR(sigma(1, 1), (K - 2 * G / 3) * e * dt, 1e-5);
  EXPECT_NEAR(p.p[0], -K * e * dt, 1e-5);
  EXPECT_NEAR(p.rho[0], 1000 * (1 - e * dt), 1e-12);
  EXPECT_NEAR(p.E[0], 0.5 * (K + 4 * G / 3) * e * e * dt * dt, 1e-11);
}

TEST(Strength, TheLedgerClosesForABodyThatSpreadsAndTurns) {
  for (const Real eps : {0.0, 0.3}) {
    Rubber cloud(2, 16, 0.05);
    World& w = cloud.world;
    Particles& p = w.particles;
    Vec momentum = Vec::Zero();
    Real scale = 0;
    for (Index i = 0; i < p.size(); ++i) {
      const Vec d = p.x.vec(i) - Vec(0.075, 0.075, 0);
      p.v.set(i, 20 * Vec(d[0], 0, 0) + 10 * Vec(-d[1], d[0], 0));
      momentum += p.m[i] * p.v.vec(i), scale += p.m[i] * p.v.vec(i).norm();
    }
    cloud.add(eps);
    w.passes.add(std::make_shared<ConstantStep>(2e-5));
    cloud.refresh();
    sample_energy(w, cloud.clock);
    w.energy.initial = w.energy.kinetic;
    PassTimer timer;
    Stepper stepper(w, cloud.neighbours.get(), {}, timer);
    Real most = 0;
    for (int k = 0; k < 1000; ++k) {
      stepper.step(cloud.clock, [](World&, const Clock&, const std::string&) {});
      sample_energy(w, cloud.clock);
      most = std::max(most, w.energy.internal);
    }
    EXPECT_GT(most, 0.05 * w.energy.initial);
    EXPECT_LT(std::abs(w.energy.residual()), 2e-3 * w.energy.initial) << eps;
    for (Index i = 0; i < p.size(); ++i) momentum -= p.m[i] * p.v.vec(i);
    EXPECT_LT(momentum.norm(), 1e-12 * scale) << eps;
  }
}

TEST(Strength, ADeviatorBesideAnEquationOfStateAddsToPressureAndSpeed) {
  Rubber cloud(3, 2);
  World& w = cloud.world;
  Particles& p = w.particles;
  cloud.settings.strength = {test::law_from_cards("MAT_ELASTIC_PLASTIC_HYDRO", "1,1000.0,3.0e5,1.0e3\n")};
  w.passes.add(courant::test::liquid_pass(9e5, w));
  cloud.add();
  cloud.refresh();
  cloud.clock.dt_old = 1e-3;
  for (Index i = 0; i < p.size(); ++i) {
    p.drhodt[i] = 10;
    Matrix D = Matrix::Zero();
    D(0, 1) = D(1, 0) = 10;  // far beyond yield
    sph_fields::strain_rate(p).set_tensor(i, D);
  }
  for (BlockPass* pass : w.passes.in_phase(Phase::laws, w))
    if (pass->name() == "eos liquid" || pass->name().starts_with("strength")) cloud.run(*pass);
  EXPECT_NEAR(p.p[0], 9e5 * 1e-5, 1e-9);
  EXPECT_NEAR(p.c[0], std::sqrt(900 + 400 / (1 + 1e-5)), 1e-9);
  EXPECT_NEAR(sph_fields::stress(p).tensor(0)(0, 1), 1e3 / std::sqrt(3.0), 1);
  EXPECT_GT(p.fields.add<Real>({.name = "plastic_strain"})[0], 0);
}

TEST(ArtificialStress, ActsAgainstTensionAlone) {
  Rubber cloud(2, 8);
  World& w = cloud.world;
  Particles& p = w.particles;
  cloud.add(0.3);
  cloud.refresh();
  Matrix turn = Matrix::Identity();
  const Real a = 0.4;
  turn.topLeftCorner<2, 2>() << std::cos(a), -std::sin(a), std::sin(a), std::cos(a);
  const Matrix sigma = turn * Vec(100, -60, 500).asDiagonal() * turn.transpose();
  for (Index i = 0; i < p.size(); ++i) {
    p.p[i] = 7;
    sph_fields::stress(p).set_tensor(i, sigma + 7 * Matrix::Identity());
  }
  cloud.run(pass_of(w, Phase::reductions, "artificial stress"));
  const Matrix expected = turn * Vec(-30, 0, 0).asDiagonal() * turn.transpose();
  EXPECT_LT((sph_fields::artificial_stress(p).tensor(0) - expected).norm(), 1e-11);

  // Forces: those of the same stress, but with the weight of each pair.
  BlockPass& forces = pass_of(w, Phase::forces, "artificial stress (forces)");
  p.f.fill(0);
  cloud.run(forces);
  Vec total = Vec::Zero();
  Real most = 0;
  for (Index i = 0; i < p.size(); ++i) total += p.f.vec(i), most = std::max(most, p.f.vec(i).norm());
  EXPECT_GT(most, 0);
  EXPECT_LT(total.norm(), 1e-12 * most);
  const Real h = 0.013, V = 1e-4, at = CubicSpline::shape(0.01 / h);
  const Index i = 0;
  Vec by_hand = Vec::Zero();
  for (Index j = 0; j < p.size(); ++j) {
    const Vec d = p.x.vec(i) - p.x.vec(j);
    const Real r = d.norm();
    if (j == i || r >= 2 * h) continue;
    const Real slope = CubicSpline::C(2) * CubicSpline::slope(r / h) / (h * h * h);
    by_hand += V * V * std::pow(CubicSpline::shape(r / h) / at, 4) * slope / r * (2 * expected * d);
  }
  EXPECT_LT((p.f.vec(i) - by_hand).norm(), 1e-10 * by_hand.norm());
}

TEST(ArtificialStress, TakesEachPartBesideItsOwnSpacing) {
  // pairs of one part have the force that they have alone, whichever part comes first
  const auto force = [](const std::vector<Real>& spacing) {
    Rubber cloud(2, 8);
    World& w = cloud.world;
    Particles& p = w.particles;
    cloud.settings.strength.assign(spacing.size(), rubber());
    cloud.settings.q.resize(spacing.size(), cloud.settings.q[0]);
    cloud.settings.spacing_of_part = spacing;
    const Index last = static_cast<Index>(spacing.size()) - 1;
    for (Index i = 0; i < p.size(); ++i) p.part[i] = last;
    if (last > 0) p.part[0] = 0, p.h[0] = 1.3 * spacing[0], p.x.set(0, Vec(-1, 0, 0));
    cloud.settings.uniform_h = last == 0;
    cloud.add(0.3);
    cloud.refresh();
    sph_fields::artificial_stress(p).fill(0);
    for (Index i = 0; i < p.size(); ++i)
      sph_fields::artificial_stress(p).set_tensor(i, -30 * Matrix::Identity());
    p.f.fill(0);
    cloud.run(pass_of(w, Phase::forces, "artificial stress (forces)"));
    Real most = 0;
    for (Index i = 0; i < p.size(); ++i)
      if (p.x.vec(i)[0] > 0.035) most = std::max(most, p.f.vec(i).norm());
    return most;
  };
  const Real alone = force({0.01});
  EXPECT_GT(alone, 0);
  EXPECT_NEAR(force({0.005, 0.01}), alone, 1e-12 * alone);
  EXPECT_NEAR(force({0.02, 0.01}), alone, 1e-12 * alone);
}
