// What SPH adds to the energy ledger: dissipation, and the energy that crosses the computational box.
#include <cmath>

#include "parallel/parallel.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/momentum.hpp"
#include "sph/sph.hpp"
#include "state/restartable.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Kinetic and internal energy of a particle, as the ledger counts them; gravity adds the potential energy.
Real kinetic_and_internal(const Particles& p, const Field<Real>& reference_volume, Index i) {
  return 0.5 * p.m[i] * p.v.vec(i).squaredNorm() + p.E[i] * reference_volume[i];
}

class SphEnergy : public Reduction, public EnergyTerm, public Refresh, public Restartable {
 public:
  SphEnergy(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours)
      : settings_(s),
        neighbours_(std::move(neighbours)),
        heat_(sph_fields::dissipation(world.particles)),
        reference_volume_(shared_fields::reference_volume.add(world.particles.fields)) {
    Particles& p = world.particles;
    riemann_ = std::get_if<RiemannFlux>(&settings_.viscosity);
    if (std::holds_alternative<BulkViscosity>(s.viscosity)) total_pressure_ = &sph_fields::pressure_plus_q(p);
    if (s.renormalised && !s.plain_pressure) excess_ = &sph_fields::renormalisation(p);
    if (!s.mu.empty()) viscous_ = &sph_fields::viscous_dissipation(p);
    if (s.has_viscous_pairs()) pair_viscosity_ = &sph_fields::viscosity(p);
    if (s.has_viscous_stress() || !s.strength.empty()) tau_ = &sph_fields::stress(p);
  }
  std::string name() const override { return "sph energy"; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(heat_).reads(world.particles.part);
    if (viscous_) a.reads(*viscous_);
  }

  void start(World& world, const Clock&) override { power_.resize(block_count(world.particles.active)); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    const Particles& p = world.particles;
    const auto& internal = settings_.heat_in_internal;  // heat that E holds already is not counted twice
    const Real* heat = heat_.data();
    const Real* viscous = viscous_ ? viscous_->data() : nullptr;
    Real sum = 0;
    if (internal.empty() && !viscous) {
#pragma omp simd reduction(+ : sum)
      for (Index i = begin; i < end; ++i) sum += heat[i];
    } else {
      for (Index i = begin; i < end; ++i)
        if (internal.empty() || !internal[p.part[i]]) sum += heat[i] + (viscous ? viscous[i] : 0);
    }
    power_[begin / block_size] = sum;
  }

  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    Real power = 0;
    for (const Real p : power_) power += p;
    ledger.dissipated += power * clock.dt_mean();
    ledger.throughput += std::abs(power) * clock.dt_mean();
    if (!halo_pairs_.empty()) {
      const Real work = halo_power(world) * clock.dt_mean();
      ledger.external_work += work;
      ledger.throughput += std::abs(work);
    }
  }

  void sample(const World& world, const Clock&, EnergyLedger& ledger) const override {
    const Particles& p = world.particles;
    ledger.internal += sum(p.active, [&](Index i) { return p.E[i] * reference_volume_[i]; });
  }

  void refreshed(World& world, const Clock&, std::span<const Index>) override {
    const Particles& p = world.particles;
    if (first_) {  // what is active at the start is the initial energy, not inflow
      first_ = false;
    } else {  // at once: from now on the sums over active particles are those of the others
      Real in = 0, out = 0;
      for (const Index i : neighbours_->entered()) in += kinetic_and_internal(p, reference_volume_, i);
      for (const Index i : neighbours_->left()) out += kinetic_and_internal(p, reference_volume_, i);
      world.energy.external_work += in - out;
      world.energy.throughput += in + out;
    }
    relist(world);
  }

  void keep(Archive& archive) override {
    archive("first", first_);
  }
  void relist(World& world) override {
    const Particles& p = world.particles;
    halo_pairs_.clear();
    if (p.moving == p.active) return;
    for (Index g = 0; g * lanes < p.active; ++g)
      for (const Index j : neighbours_->listed(g)) {
        const Index of = neighbours_->particle_of(p, j);
        if (of < p.active)
          continue;  // what active particles and ghosts of such, or of nothing, do to each other stays inside
        for (Index i = g * lanes; i < std::min((g + 1) * lanes, p.active); ++i)
          if ((p.x.vec(i) - p.x.vec(j)).norm() <
              neighbours_->support() * std::max(p.h[i], p.h[of]) + neighbours_->skin())
            halo_pairs_.push_back({i, j, of});
      }
  }

 private:
  /// An active particle and one of the halo, or a ghost of one.
  struct Pair {
    Index i, j, of;  ///< `of`: the halo particle; j, where its ghost counts, else the same
  };

  /// Power that halo particles j, whose state is frozen, put into active ones: the pair's part of the change
  /// of kinetic and internal energy of i and of the dissipation counted for i.
  Real halo_power(World& world) const {
    return with_kernel(settings_.kernel, [&](auto kernel) {
      return with_dimension(world.dim, [&](auto dim) {
        return with_bool(settings_.uniform_h, [&](auto uniform) {
          return with_bool(std::holds_alternative<MonaghanViscosity>(settings_.viscosity), [&](auto visc) {
            return halo_power_of<decltype(kernel), dim.value, uniform.value, visc.value>(world);
          });
        });
      });
    });
  }

  template <class Kernel, int Dim, bool UniformH, bool Monaghan>
  Real halo_power_of(World& world) const {
    const Particles& p = world.particles;
    const Real* pressure = total_pressure_ ? total_pressure_->data() : p.p.data();
    Real total = 0;
    for (const auto [i, j, of] : halo_pairs_) {
      const Real h = p.h[i];
      const PartViscosity &qi = settings_.q[p.part[i]], &qj = settings_.q[p.part[of]];
      MomentumPair<Kernel, Dim, UniformH, Monaghan> pair{h,
                                                         1 / h,
                                                         Kernel::C(Dim) / power<Dim + 1>(h),
                                                         tiny_distance2 * h * h,
                                                         pressure[i],
                                                         p.rho[i],
                                                         qi.q1 * p.c[i],
                                                         0,
                                                         1 / p.rho[i]};
      if constexpr (Monaghan) pair.q2 = std::get<MonaghanViscosity>(settings_.viscosity).q2;
      const Vec d = p.x.vec(i) - p.x.vec(j), vi = p.v.vec(i), vj = p.v.vec(j);
      const Real r2 = d.squaredNorm() + pair.tiny;
      auto s = pair(r2, (vi - vj).dot(d), pressure[of], p.rho[of], qj.q1 * p.c[of], p.h[of]);
      if (riemann_)  // q1 is 1
        s.viscous = pair.inverse_rho * slope_over_r<Kernel, Dim>(r2, h) *
                    riemann_excess(*riemann_, 0.5 * (p.rho[i] + p.rho[of]), 0.5 * (p.c[i] + p.c[of]),
                                   -(vi - vj).dot(d) / std::sqrt(r2));
      // the work on i, less what i stores or burns of it by p_i v_ij.d, tau_i:D and its half of Pi
      Real power = -(s.pressure_i * vj + s.pressure_j * vi + 0.5 * s.viscous * (vi + vj)).dot(d);
      if (pair_viscosity_)
        power += pair.inverse_rho * slope_over_r<Kernel, Dim>(r2, h) *
                 ((*pair_viscosity_)[i] + (*pair_viscosity_)[j]) * (vi - vj).dot(0.5 * (vi + vj));
      if (tau_) {
        const Real gi = slope_over_r<Kernel, Dim>(r2, h),
                   gj = slope_over_r<Kernel, Dim>(r2, UniformH ? h : p.h[of]);
        power += pair.inverse_rho * (gi * (tau_->tensor(i) * d).dot(vj) + gj * (tau_->tensor(j) * d).dot(vi));
      }
      if (excess_) {  // of j it is 0
        const Vec e = excess_->tensor(i) * d;
        power -= settings_.reverse_correction ? s.pressure_j * e.dot(vi) - s.pressure_i * e.dot(vi - vj)
                                              : s.pressure_i * e.dot(vj);
      }
      total += p.m[i] * p.m[of] / p.rho[of] * power;
    }
    return total;
  }

  /// (dW/dr)/r
  template <class Kernel, int Dim>
  static Real slope_over_r(Real r2, Real h) {
    const Real r = std::sqrt(r2);
    return Kernel::C(Dim) / power<Dim + 1>(h) * Kernel::slope(r / h) / r;
  }

  SphSettings settings_;
  std::shared_ptr<Neighbours> neighbours_;
  Field<Real>& heat_;
  Field<Real>& reference_volume_;
  const RiemannFlux* riemann_ = nullptr;
  Field<Real>* viscous_ = nullptr;
  Field<Real>* pair_viscosity_ = nullptr;
  Field<Real>* total_pressure_ = nullptr;
  Field<Real>* tau_ = nullptr;
  Field<Real>* excess_ = nullptr;  ///< of renormalised forms
  static constexpr Index lanes = Neighbours::lanes;
  std::vector<Real> power_;  ///< dissipated in each block [ML2/T3]
  std::vector<Pair> halo_pairs_;
  bool first_ = true;
};

}  // namespace

std::shared_ptr<EnergyTerm> make_sph_energy(const SphSettings& s, World& world,
                                            std::shared_ptr<Neighbours> neighbours) {
  return std::make_shared<SphEnergy>(s, world, std::move(neighbours));
}

}  // namespace courant
