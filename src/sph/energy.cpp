// What SPH adds to the energy ledger: dissipation, and the energy that crosses the computational box.
#include "parallel/parallel.hpp"
#include "sph/momentum.hpp"
#include "sph/sph.hpp"

namespace courant {

namespace {

/// Energies of an active particle that the ledger counts: kinetic, internal, and (through gravity, elsewhere) potential.
Real kinetic_and_internal(const Particles& p, const Field<Real>& reference_volume, Index i) {
  return 0.5 * p.m[i] * p.v.vec(i).squaredNorm() + p.E[i] * reference_volume[i];
}

class SphEnergy : public EnergyTerm, public Refresh {
 public:
  SphEnergy(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours)
      : settings_(s),
        neighbours_(std::move(neighbours)),
        heat_(world.particles.fields.add<Real>({.name = "dissipation", .dimension = "ML2/T3"})),
        reference_volume_(world.particles.fields.add<Real>({.name = "reference_volume", .dimension = "L3"})) {
    if (!s.mu.empty()) viscous_ = &world.particles.fields.add<Real>({.name = "viscous_dissipation", .dimension = "ML2/T3"});
  }
  std::string name() const override { return "sph energy"; }

  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const Particles& p = world.particles;
    const auto& internal = settings_.heat_in_internal;  // heat that E holds already is not counted twice
    const Real* heat = heat_.data();
    const Real* viscous = viscous_ ? viscous_->data() : nullptr;
    const Real power = sum(p.active, [&](Index i) {
      if (!internal.empty() && internal[p.part[i]]) return Real(0);
      return heat[i] + (viscous ? viscous[i] : 0);
    });
    ledger.dissipated += power * clock.dt_mean();
    ledger.throughput += power * clock.dt_mean() + inflow_;
    ledger.external_work += exchanged_;
    exchanged_ = inflow_ = 0;
    if (!rim_pairs_.empty()) {
      const Real work = rim_power(world) * clock.dt_mean();
      ledger.external_work += work;
      ledger.throughput += std::abs(work);
    }
  }

  void sample(const World& world, const Clock&, EnergyLedger& ledger) const override {
    const Particles& p = world.particles;
    ledger.kinetic += sum(p.active, [&](Index i) { return 0.5 * p.m[i] * p.v.vec(i).squaredNorm(); });
    ledger.internal += sum(p.active, [&](Index i) { return p.E[i] * reference_volume_[i]; });
  }

  void refreshed(World& world, const Clock&, std::span<const Index>) override {
    const Particles& p = world.particles;
    if (first_) {  // what is active at the start is the initial energy, not inflow
      first_ = false;
    } else {
      for (const Index i : neighbours_->entered()) {
        exchanged_ += kinetic_and_internal(p, reference_volume_, i);
        inflow_ += kinetic_and_internal(p, reference_volume_, i);
      }
      for (const Index i : neighbours_->left()) exchanged_ -= kinetic_and_internal(p, reference_volume_, i);
    }
    rim_pairs_.clear();
    if (p.moving == p.active) return;
    for (Index i = 0; i < p.active; ++i)
      for (const Index j : neighbours_->of(i))
        if (j >= p.active) rim_pairs_.push_back({i, j});
  }

 private:
  struct Pair {
    Index i, j;
  };

  /// Power that rim particles j, whose state is frozen, put into active ones: the pair's part of the change of kinetic and
  /// internal energy of i and of the dissipation counted for i.
  Real rim_power(World& world) const {
    return with_dimension(world.dim, [&](auto dim) {
      return with_bool(settings_.uniform_h, [&](auto uniform) {
        return with_bool(std::holds_alternative<MonaghanViscosity>(settings_.viscosity),
                         [&](auto visc) { return rim_power_of<dim.value, uniform.value, visc.value>(world); });
      });
    });
  }

  template <int Dim, bool UniformH, bool Monaghan>
  Real rim_power_of(World& world) const {
    const Particles& p = world.particles;
    Real total = 0;
    for (const Pair& r : rim_pairs_) {
      const Real h = p.h[r.i];
      const PartViscosity &qi = settings_.q[p.part[r.i]], &qj = settings_.q[p.part[r.j]];
      MomentumPair<Dim, UniformH, Monaghan> pair{h, 1 / h, CubicSpline<Dim>::C / power<Dim + 1>(h), tiny_distance2 * h * h,
                                                 p.p[r.i], p.rho[r.i], qi.q1 * p.c[r.i], 0, 1 / p.rho[r.i]};
      if constexpr (Monaghan) pair.q2 = std::get<MonaghanViscosity>(settings_.viscosity).q2;
      const Vec d = p.x.vec(r.i) - p.x.vec(r.j), u = p.v.vec(r.i) - p.v.vec(r.j);
      const Real v_dot_r = u.dot(d);
      const auto s = pair(d.squaredNorm() + pair.tiny, v_dot_r, p.p[r.j], p.rho[r.j], qj.q1 * p.c[r.j], p.h[r.j]);
      const Real w = p.m[r.i] * p.m[r.j] / p.rho[r.j];
      const Real on_i = -(s.pressure_i + s.pressure_j + s.viscous) * d.dot(p.v.vec(r.i));  // change of kinetic energy
      const Real compression = s.pressure_i * v_dot_r;                                    // change of internal energy
      total += w * (on_i + compression + 0.5 * s.viscous * v_dot_r);
    }
    return total;
  }

  SphSettings settings_;
  std::shared_ptr<Neighbours> neighbours_;
  Field<Real>& heat_;
  Field<Real>& reference_volume_;
  Field<Real>* viscous_ = nullptr;
  std::vector<Pair> rim_pairs_;
  bool first_ = true;
  Real exchanged_ = 0, inflow_ = 0;
};

}  // namespace

std::shared_ptr<EnergyTerm> make_sph_energy(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours) {
  auto energy = std::make_shared<SphEnergy>(s, world, std::move(neighbours));
  world.refreshes.push_back(energy);
  return energy;
}

}  // namespace courant
