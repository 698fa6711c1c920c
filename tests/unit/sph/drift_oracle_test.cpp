// The loops of shifting and XSPH of every instruction set against the plain sum over all pairs.
#include <gtest/gtest.h>

#include <cmath>

#include "base/instruction_set.hpp"
#include "cloud.hpp"
#include "sph/core/fields.hpp"
#include "sph/kernel/kernel.hpp"
#include "sph/options/drift.hpp"

using namespace courant;
using courant::test::Cloud;

namespace {

constexpr Real eps = 0.4, strength = 1.5, pairing = 0.3;

/// What the passes must give for particle i.
struct ExpectedDrift {
  Vec gradient = Vec::Zero(), normal = Vec::Zero(), xsph = Vec::Zero();
  Matrix velocity_gradient = Matrix::Zero();
  Real spread = 0, filling = 0, rate = 0, drift_rate = 0;
  Real weight = 0;     ///< of XSPH
  Real round_off = 0;  ///< of the rates, where two particles are in one position
  bool edge = false;
};

template <int Dim>
Real kernel(Real r, Real h) {
  return CubicSpline::C(Dim) * CubicSpline::shape(r / h) / std::pow(h, Dim);
}
template <int Dim>
Real slope(Real r, Real h) {
  return CubicSpline::C(Dim) * CubicSpline::slope(r / h) / std::pow(h, Dim + 1);
}

template <int Dim>
ExpectedDrift oracle(Particles& p, Index i, Real surface, Real half_step) {
  ExpectedDrift e;
  const Field<Real>&spread = sph_fields::spread(p), &drifted = sph_fields::drifted(p);
  const Real h = p.h[i];
  for (Index j = 0; j < p.moving; ++j) {
    const Vec d = p.x.vec(i) - p.x.vec(j), u = p.v.vec(j) - p.v.vec(i);
    const Real r = d.norm(), V = p.m[j] / p.rho[j];
    if (!(r < 2 * std::max(h, p.h[j]))) continue;
    const Real mean_kernel = 0.5 * (kernel<Dim>(r, h) + kernel<Dim>(r, p.h[j]));
    const Real weight = p.m[j] / (0.5 * (p.rho[i] + p.rho[j])) * mean_kernel;
    e.xsph += eps * weight * u, e.weight += weight;
    if (!(r < 2 * h)) continue;
    e.filling += V * kernel<Dim>(r, h);
    e.edge = e.edge || spread[j] < surface;
    if (j == i) continue;
    if (r == 0) {  // grad W is 0 there and grows by -3 C / h^(dim + 2)
      const Vec u_ij = drifted.vec(i) - drifted.vec(j);
      const Vec changed = -3 * CubicSpline::C(Dim) / std::pow(h, Dim + 2) * u_ij;
      e.round_off = 1e-3 * p.rho[i] * half_step * V * changed.norm() * (u.norm() + u_ij.norm());
      e.rate += p.rho[i] * half_step * V * u.dot(changed);
      e.drift_rate -= p.rho[i] * half_step * V * (u_ij - u).dot(changed);
      continue;
    }
    const Vec grad = slope<Dim>(r, h) / r * d;
    const Real W = kernel<Dim>(r, h) / kernel<Dim>(0.01, 0.012);
    e.gradient += V * (1 + pairing * std::pow(W * std::pow(h / 0.012, Dim), 4)) * grad;
    e.normal += V * (spread[j] - spread[i]) * grad;
    e.spread -= V * d.dot(grad);
    e.velocity_gradient += V * u * grad.transpose();
    // grad W half a step ago, by differences: of the path by velocity it is taken elsewhere
    const Vec w = drifted.vec(i) - drifted.vec(j), v = -u;
    const auto slope_at = [&](const Vec& y) { return Vec(slope<Dim>(y.norm(), h) / y.norm() * y); };
    const auto changed = [&](const Vec& way) {
      const Real s = 1e-9;
      return Vec((slope_at(d + s * way) - slope_at(d - s * way)) / (2 * s));
    };
    e.rate -= p.rho[i] * half_step * V * v.dot(changed(w));
    e.drift_rate += p.rho[i] * V * w.dot(grad - half_step * changed(v + w));
  }
  return e;
}

void expect_near(const Vec& a, const Vec& b, Real scale) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-11 * scale);
}

template <int Dim>
void compare(bool uniform_h, bool alone, std::optional<Neighbours::Region> region, bool normed = false) {
  Cloud cloud(Dim, Dim == 2 ? 21 : 9, 0.01, 0.25);
  World& w = cloud.world;
  Particles& p = w.particles;
  cloud.settings.uniform_h = uniform_h;
  cloud.settings.shift = {strength, pairing, Dim - 0.5, true};
  cloud.settings.xsph = eps, cloud.settings.xsph_normed = normed;
  cloud.neighbours = std::make_shared<Neighbours>(cloud.neighbours->skin(), region);
  const auto volumes = make_pair_volumes(w);
  add_drifts(cloud.settings, BodyAcceleration(), w);
  if (!alone) add_shifting(cloud.settings, w, cloud.neighbours, volumes);
  add_xsph(cloud.settings, w, cloud.neighbours, volumes);
  if (alone) add_drift_rate(cloud.settings, w, cloud.neighbours, volumes);
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> u(-1, 1);
  for (Index i = 0; i < p.size(); ++i) {
    p.v.set(i, {u(random), u(random), Dim == 3 ? u(random) : 0});
    p.rho[i] = 1000 + 200 * u(random);
    p.m[i] *= 1 + 0.3 * u(random);
    if (!uniform_h) p.h[i] *= 1 + 0.3 * u(random);
    sph_fields::spread(p)[i] = Dim + 0.6 * u(random);
  }
  p.x.set(3, p.x.vec(4));  // two particles in one position
  cloud.refresh();
  for (Index i = 0; i < p.moving; ++i)
    sph_fields::drifted(p).set(i, {u(random), u(random), Dim == 3 ? u(random) : 0});
  cloud.clock.dt_old = 1e-3;
  for (Index i = 0; i < p.active; ++i) p.drhodt[i] = 0;
  for (BlockPass* rate : w.passes.in_phase(Phase::rates, w)) cloud.run(*rate);
  for (Index i = 0; i < p.active; ++i) {
    const ExpectedDrift e = oracle<Dim>(p, i, Dim - 0.5, 5e-4);
    const auto vec = [&](const Field<Real>& f) {
      return Vec(f.data(0)[i], f.data(1)[i], Dim == 3 ? f.data(2)[i] : 0);
    };
    expect_near(vec(drift_velocity(p, xsph_statistics)), normed ? Vec(e.xsph / e.weight) : e.xsph, 10);
    EXPECT_NEAR(sph_fields::drift_rate(p)[i], e.drift_rate, 1e-6 * 1e5 + e.round_off);
    EXPECT_NEAR(p.drhodt[i], e.rate + e.drift_rate, 1e-6 * 1e5 + e.round_off);
    if (alone) continue;
    expect_near(vec(sph_fields::shift_gradient(p)), e.gradient, 1e4);
    expect_near(vec(sph_fields::surface_normal(p)), e.normal, 1e3);
    for (int k = 0; k < Dim; ++k)
      expect_near(vec(sph_fields::velocity_gradient(p, k)), e.velocity_gradient.row(k), 1e3);
    EXPECT_NEAR(sph_fields::new_spread(p)[i], e.spread, 1e-11);
    EXPECT_NEAR(sph_fields::filling(p)[i], e.filling, 1e-11);
    EXPECT_EQ(sph_fields::surface_near(p)[i] > 0, e.edge);
  }
}

class DriftLoops : public testing::TestWithParam<InstructionSet> {};

TEST_P(DriftLoops, GiveWhatTheSumOverAllPairsGives) {
  const InstructionSet before = instruction_set();
  use_instruction_set(GetParam());
  const Neighbours::Region box{Vec(-1, 0.024, -1), Vec(1, 0.051, 1)};
  for (const bool uniform_h : {true, false})
    for (const auto& region : {std::optional<Neighbours::Region>(), std::optional(box)}) {
      SCOPED_TRACE(testing::Message() << "uniform h " << uniform_h << ", box " << region.has_value());
      for (const bool alone : {false, true}) {
        compare<2>(uniform_h, alone, region);
        compare<3>(uniform_h, alone, region);
      }
      compare<2>(uniform_h, true, region, true);
      compare<3>(uniform_h, true, region, true);
    }
  use_instruction_set(before);
}

INSTANTIATE_TEST_SUITE_P(All, DriftLoops, testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
