// Passes over single particles between the rates and the forces: bulk viscosity, viscous stress, smoothing
// length.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "parallel/parallel.hpp"
#include "sph/core/fields.hpp"
#include "sph/materials/dynamic_viscosity.hpp"
#include "sph/sph.hpp"
#include "state/restartable.hpp"

namespace courant {

namespace {

/// IAVIS 1: q = rho h (Q1 h d^2 - Q2 c d) for d = div v < 0, else 0, the form of solid elements with the
/// length h.
class BulkViscosityPass : public Material, public Refresh, public Restartable {
 public:
  BulkViscosityPass(const SphSettings& s, World& world)
      : q_(s.q),
        total_(sph_fields::pressure_plus_q(world.particles)),
        heat_(sph_fields::dissipation(world.particles)) {
    if (!s.has_density_sources()) return;
    bulk_ = &sph_fields::bulk_dissipation(world.particles);
    sources_ = &sph_fields::density_sources(world.particles);
  }
  std::string name() const override { return "bulk viscosity"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.drhodt).reads(p.rho).reads(p.h).reads(p.c).reads(p.p).reads(p.m).reads(p.part).writes(total_);
    a.updates(heat_);
    if (bulk_) a.updates(*bulk_).reads(*sources_);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    Particles& p = world.particles;
    for (Index i = begin; i < end; ++i) {
      const Real compression = p.drhodt[i] - (sources_ ? (*sources_)[i] : 0);
      const Real d = std::min(-compression / p.rho[i], Real(0));  // div v
      const PartViscosity& k = q_[p.part[i]];
      const Real q = p.rho[i] * p.h[i] * (k.q2 * p.h[i] * d * d - k.q1 * p.c[i] * d);
      total_[i] = p.p[i] + q;
      const Real power = -q * d * p.m[i] / p.rho[i];
      heat_[i] = bulk_ ? heat_[i] - (*bulk_)[i] + power : power;
      if (bulk_) (*bulk_)[i] = power;
    }
  }
  void refreshed(World& world, const Clock&, std::span<const Index>) override { loaded(world); }
  void keep(Archive&) override {}
  void loaded(World& world) override {
    const Particles& p = world.particles;
    for (Index i = p.active; i < p.moving; ++i) total_[i] = p.p[i];  // the halo's pressure does not change
  }

 private:
  std::vector<PartViscosity> q_;
  Field<Real>& total_;
  Field<Real>& heat_;
  Field<Real>*bulk_ = nullptr, *sources_ = nullptr;  ///< of DensitySource, which has given its heat already
};

/// MAT_NULL: tau = 2 MU (D - tr D/3), eqs 11-12; MU with an eddy viscosity where there is one.
class ViscousStress : public Material {
 public:
  ViscousStress(const SphSettings& s, World& world)
      : viscosity_(s, world),
        rate_(sph_fields::strain_rate(world.particles)),
        tau_(sph_fields::stress(world.particles)),
        power_(sph_fields::viscous_dissipation(world.particles)) {}
  std::string name() const override { return "viscous stress"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    viscosity_.declare(p, a);
    a.reads(rate_).reads(p.m).reads(p.rho).writes(tau_).writes(power_);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    Particles& p = world.particles;
    for (Index i = begin; i < end; ++i) {
      const Real mu = viscosity_.of(p, i);
      const Real third = (rate(0, i) + rate(1, i) + rate(2, i)) / 3;
      Real power = 0;
      for (int k = 0; k < 6; ++k) {
        const Real deviator = rate(k, i) - (k < 3 ? third : 0);
        tau_.data(k)[i] = 2 * mu * deviator;
        power += (k < 3 ? 1 : 2) * 2 * mu * deviator * rate(k, i);
      }
      power_[i] = power * p.m[i] / p.rho[i];
    }
  }

 private:
  Real rate(int k, Index i) const { return rate_.data(k)[i]; }
  DynamicViscosity viscosity_;
  Field<Real>&rate_, &tau_, &power_;
};

/// DERIV 0: dh/dt = h div v / dim, within HMIN h0 and HMAX h0. Particles at a bound are counted. Neighbours
/// read h during the rates, so it follows the density at the end of the step.
class SmoothingLength : public Preparation {
 public:
  SmoothingLength(const SphSettings& s, World& world)
      : low_(s.h_min_factor),
        high_(s.h_max_factor),
        h0_(world.particles.fields.add<Real>({.name = "initial_smoothing_length", .dimension = "L"})) {
    for (Index i = 0; i < world.particles.size(); ++i) h0_[i] = world.particles.h[i];
    world.counters["smoothing_length_at_bound"] = 0;
  }
  std::string name() const override { return "smoothing length"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.drhodt).reads(p.rho).reads(p.part).reads(h0_).updates(p.h);
  }
  void start(World& world, const Clock&) override {
    at_bound_.assign(block_count(world.particles.moving), 0);
  }
  void block(World& world, const Clock& clock, Index begin, Index end) override {
    Particles& p = world.particles;
    for (Index i = begin; i < std::min(end, p.active); ++i) {
      const Real grown = p.h[i] * (1 - p.drhodt[i] / p.rho[i] * clock.dt / world.dim);
      const Real low = low_[p.part[i]] * h0_[i], high = high_[p.part[i]] * h0_[i];
      p.h[i] = std::clamp(grown, low, high);
      at_bound_[begin / block_size] += grown < low || grown > high ? 1 : 0;
    }
  }
  void finish(World& world, const Clock&) override {
    auto& counter = world.counters["smoothing_length_at_bound"];
    counter = std::max(counter, std::accumulate(at_bound_.begin(), at_bound_.end(), std::int64_t(0)));
  }

 private:
  std::vector<Real> low_, high_;
  std::vector<std::int64_t> at_bound_;  ///< in each block
  Field<Real>& h0_;
};

}  // namespace

std::shared_ptr<Material> make_bulk_viscosity(const SphSettings& s, World& world) {
  return std::make_shared<BulkViscosityPass>(s, world);
}
std::shared_ptr<Material> make_viscous_stress(const SphSettings& s, World& world) {
  return std::make_shared<ViscousStress>(s, world);
}
std::shared_ptr<Preparation> make_smoothing_length(const SphSettings& s, World& world) {
  return std::make_shared<SmoothingLength>(s, world);
}

}  // namespace courant
