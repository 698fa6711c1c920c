#include <gtest/gtest.h>

#include <cmath>

#include "cloud.hpp"
#include "parallel/parallel.hpp"
#include "sph/core/fields.hpp"
#include "sph/kernel/kernel.hpp"

using namespace courant;
using courant::test::Cloud;

namespace {

void random_state(Cloud& cloud, unsigned seed = 7) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> u(-1, 1);
  Particles& p = cloud.world.particles;
  for (Index i = 0; i < p.size(); ++i) {
    p.v.set(i, {u(random), u(random), cloud.world.dim == 3 ? u(random) : 0});
    p.p[i] = 1000 * u(random);
    p.rho[i] = 1000 + 20 * u(random);
  }
}

/// Index of the particle nearest to the middle of the cloud.
Index middle(const World& world) {
  const Particles& p = world.particles;
  Vec centre = Vec::Zero();
  for (Index i = 0; i < p.size(); ++i) centre += p.x.vec(i) / p.size();
  Index best = 0;
  for (Index i = 1; i < p.size(); ++i)
    if ((p.x.vec(i) - centre).norm() < (p.x.vec(best) - centre).norm()) best = i;
  return best;
}

/// dW/dr of the 2D kernel
Real kernel_slope_2d(Real r, Real h) {
  return CubicSpline::C(2) * CubicSpline::slope(r / h) / (h * h * h);
}

struct SumCase {
  int dim;
  bool uniform;
  bool monaghan;
  bool stress;
};
class Pairs : public testing::TestWithParam<SumCase> {};

/// A random cloud with the passes of one case, evaluated once, and the powers that must balance.
struct Evaluated {
  Cloud cloud;
  std::shared_ptr<EnergyTerm> ledger;
  Vec force = Vec::Zero();
  Real scale = 0, kinetic = 0, internal = 0, dissipated = 0;

  Evaluated(const SumCase& c, std::optional<Neighbours::Region> region)
      : cloud(c.dim, c.dim == 2 ? 20 : 8, 0.01, 0.2) {
    World& w = cloud.world;
    Particles& p = w.particles;
    cloud.settings.uniform_h = c.uniform;
    if (!c.uniform)
      for (Index i = 0; i < p.size(); ++i) p.h[i] *= 1 + 0.2 * (i % 3);
    if (c.stress) cloud.settings.mu.assign(1, 2.0);
    cloud.settings.viscosity =
        c.monaghan ? ArtificialViscosity(MonaghanViscosity{1.5}) : ArtificialViscosity(BulkViscosity{});
    random_state(cloud);
    cloud.neighbours = std::make_shared<Neighbours>(cloud.neighbours->skin(), region);
    cloud.make_pairs();
    std::vector<std::shared_ptr<Material>> updates;
    if (!c.monaghan) updates.push_back(make_bulk_viscosity(cloud.settings, w));
    if (c.stress) updates.push_back(make_viscous_stress(cloud.settings, w));
    ledger = w.passes.add(make_sph_energy(cloud.settings, w, cloud.neighbours));
    cloud.refresh();
    if (c.stress)  // halo particles keep the stress they had
      for (const int component : {0, 1, 3})
        for (Index i = p.active; i < p.moving; ++i) sph_fields::stress(p).data(component)[i] = 3.0 + i % 5;
    cloud.run_rates();
    for (auto& u : updates) cloud.run(*u);
    cloud.run_forces();
    auto& heat = p.fields.add<Real>({.name = "dissipation", .dimension = "ML2/T3"});
    auto* viscous = dynamic_cast<Field<Real>*>(p.fields.find("viscous_dissipation"));
    for (Index i = 0; i < p.active; ++i) {
      force += p.f.vec(i);
      scale += p.f.vec(i).norm();
      kinetic += p.f.vec(i).dot(p.v.vec(i));
      internal += p.m[i] * p.p[i] / (p.rho[i] * p.rho[i]) * p.drhodt[i];
      dissipated += heat[i] + (viscous ? (*viscous)[i] : 0);
      EXPECT_GE(heat[i], 0);
    }
  }
};

TEST_P(Pairs, ConserveMomentumAndGiveTheEnergyTheyTake) {
  const Evaluated e(GetParam(), std::nullopt);
  EXPECT_LT(e.force.norm(), 1e-13 * e.scale);
  EXPECT_GT(e.dissipated, 0);
  // What forces take from the motion is what pressure stores and viscosity burns: exact for the adjoint
  // forms.
  EXPECT_NEAR(e.kinetic + e.internal + e.dissipated, 0,
              1e-11 * (std::abs(e.kinetic) + std::abs(e.internal) + e.dissipated));
}

TEST_P(Pairs, CountTheWorkOfParticlesOutsideTheBox) {
  Evaluated e(GetParam(), Neighbours::Region{Vec(-1, -1, -1), Vec(0.035, 1, 1)});
  World& w = e.cloud.world;
  ASSERT_GT(w.particles.moving, w.particles.active);
  e.cloud.clock.dt = e.cloud.clock.dt_old = 1e-3;
  e.cloud.run(dynamic_cast<BlockPass&>(*e.ledger));
  e.ledger->record(w, e.cloud.clock, w.energy);
  const Real power = e.kinetic + e.internal + e.dissipated;
  EXPECT_GT(std::abs(power), 1e-3 * e.dissipated);
  EXPECT_NEAR(w.energy.external_work, power * 1e-3,
              1e-14 * (std::abs(e.kinetic) + std::abs(e.internal) + e.dissipated));
  EXPECT_NEAR(w.energy.dissipated, e.dissipated * 1e-3, 1e-12 * e.dissipated);
}

INSTANTIATE_TEST_SUITE_P(All, Pairs,
                         testing::Values(SumCase{2, true, true, false}, SumCase{2, false, true, false},
                                         SumCase{2, true, false, false}, SumCase{2, true, true, true},
                                         SumCase{2, false, false, true}, SumCase{3, true, true, false},
                                         SumCase{3, false, true, false}, SumCase{3, true, false, true},
                                         SumCase{3, false, true, true}));

TEST(Continuity, GivesTheDivergenceOfALinearField) {
  for (const int dim : {2, 3}) {
    Cloud cloud(dim, dim == 2 ? 21 : 13, 0.01, 0, 1.2);
    World& w = cloud.world;
    for (Index i = 0; i < w.particles.size(); ++i) {
      const Vec x = w.particles.x.vec(i);
      w.particles.v.set(i, {2 * x[0] + x[1], -0.5 * x[1], dim == 3 ? 3 * x[2] : 0});
    }
    cloud.settings.mu.assign(1, 1.0);
    cloud.make_pairs();
    cloud.refresh();
    cloud.run_rates();
    const Index i = middle(w);
    const Real div = dim == 2 ? 1.5 : 4.5;
    // plain SPH on a lattice with h = 1.2 dx: its discrete second moment misses 1 by a few per cent in 2D
    EXPECT_NEAR(w.particles.drhodt[i] / -w.particles.rho[i], div, 0.03 * div);
    const Matrix strain = sph_fields::strain_rate(w.particles).tensor(i);
    EXPECT_NEAR(strain(0, 0), 2, 0.06);
    EXPECT_NEAR(strain(1, 1), -0.5, 0.015);
    EXPECT_NEAR(strain(0, 1), 0.5, 0.015);
  }
}

TEST(Momentum, GivesTheGradientOfALinearPressure) {
  for (const int dim : {2, 3}) {
    Cloud cloud(dim, dim == 2 ? 21 : 13, 0.01, 0, 1.2);
    World& w = cloud.world;
    for (Index i = 0; i < w.particles.size(); ++i) w.particles.p[i] = 500 * w.particles.x.vec(i)[1];
    cloud.make_pairs();
    cloud.refresh();
    cloud.run_rates();
    cloud.run_forces();
    const Index i = middle(w);
    const Vec a = w.particles.f.vec(i) / w.particles.m[i];
    EXPECT_NEAR(a[1], -0.5, 0.015);
    EXPECT_NEAR(a[0], 0, 1e-12);
  }
}

TEST(ViscousStress, GivesTheForceOfACurvedVelocityProfile) {
  // v_x = a y^2 in a fluid of viscosity MU: dv_x/dt = 2 a MU / rho, the term of eqs 7 and 12
  for (const int dim : {2, 3}) {
    Cloud cloud(dim, dim == 2 ? 25 : 15, 0.01, 0, 1.2);
    World& w = cloud.world;
    const Real a = 40, mu = 3;
    for (Index i = 0; i < w.particles.size(); ++i)
      w.particles.v.set(i, {a * std::pow(w.particles.x.vec(i)[1], 2), 0, 0});
    cloud.settings.mu.assign(1, mu);
    cloud.settings.q.assign(1, {0, 0});
    cloud.make_pairs();
    auto stress = make_viscous_stress(cloud.settings, w);
    cloud.refresh();
    cloud.run_rates();
    cloud.run(*stress);
    cloud.run_forces();
    const Index i = middle(w);
    const Real expected = 2 * a * mu / 1000;
    EXPECT_NEAR(w.particles.f.vec(i)[0] / w.particles.m[i], expected, 0.05 * expected) << dim << "D";
    EXPECT_NEAR(w.particles.f.vec(i)[1] / w.particles.m[i], 0, 1e-9);
  }
}

TEST(Monaghan, ActsOnApproachOnlyAndHasTheSizeOfEquation15) {
  Cloud cloud(2, 2, 0.01, 0);
  World& w = cloud.world;
  Particles& p = w.particles;
  p.fields.resize(2);  // two particles on the x axis
  p.x.set(0, {0, 0, 0});
  p.x.set(1, {0.01, 0, 0});
  cloud.settings.viscosity = MonaghanViscosity{2.0};
  for (const Real approach : {1.0, -1.0}) {
    p.v.set(0, {approach, 0, 0});
    p.v.set(1, {0, 0, 0});
    p.p[0] = p.p[1] = 0;
    p.f.fill(0);
    cloud.neighbours->force_refresh();
    cloud.make_pairs();
    cloud.refresh();
    cloud.run_rates();
    cloud.run_forces();
    const Real h = 0.012, phi = h * (-0.01 * approach) / (0.01 * 0.01 + 0.01 * h * h);
    const Real Pi = approach > 0 ? (-0.1 * 30 * phi + 2.0 * phi * phi) / 1000 : 0;
    const Real dW = kernel_slope_2d(0.01, h);
    const Index first = p.id[0] == 1 ? 0 : 1;
    EXPECT_NEAR(p.f.vec(first)[0] / p.m[first], p.m[0] * Pi * dW, 1e-9 * std::abs(p.m[0] * dW));
  }
}

TEST(Sph, SameBitsOnAnyNumberOfThreads) {
  std::vector<Real> reference;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    Cloud cloud(3, 14, 0.01, 0.2);
    random_state(cloud);
    cloud.make_pairs();
    cloud.refresh();
    cloud.run_rates();
    cloud.run_forces();
    std::vector<Real> result;
    for (int k = 0; k < 3; ++k)
      result.insert(result.end(), cloud.world.particles.f.data(k),
                    cloud.world.particles.f.data(k) + cloud.world.particles.size());
    if (reference.empty()) reference = result;
    EXPECT_EQ(reference, result) << n << " threads";
  }
  set_threads(0);
}

}  // namespace
