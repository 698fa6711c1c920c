#include "sph/fields.hpp"
#include "sph/pair_geometry.hpp"
#include "sph/sph.hpp"
#include "sph/view.hpp"

namespace courant {

namespace {

/// Continuity, and what else needs the velocities of neighbours: Monaghan's viscosity and the velocity
/// gradient.
class PairRates : public Rate {
 public:
  PairRates(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry)
      : geometry_(std::move(geometry)) {
    Particles& p = world.particles;
    const bool viscous = std::holds_alternative<MonaghanViscosity>(s.viscosity), gradient = !s.mu.empty();
    volume_ = &sph_fields::volume(p);
    heat_ = &sph_fields::dissipation(p);
    if (viscous) {
      viscous_speed_ = &sph_fields::viscous_speed(p);
      q2_ = std::get<MonaghanViscosity>(s.viscosity).q2;
    }
    if (gradient) strain_ = sph_fields::strain_rate(p);
    RatesChoice choice{s.dim, s.uniform_h, viscous, gradient, Geometry::compute};
    compute_ = rates_loop(choice);
    choice.geometry = Geometry::store;
    store_ = rates_loop(choice);
  }
  std::string name() const override { return "sph rates"; }

  void start(World& world, const Clock&) override {
    geometry_->prepare();
    a_ = particle_arrays(world.particles);
    a_.V = volume_->data();
    a_.qc = viscous_speed_ ? viscous_speed_->data() : nullptr;
    a_.heat = heat_->data();
    a_.q2 = q2_;
    for (int k = 0; k < 6; ++k) a_.strain[k] = strain_[k] ? strain_[k]->data() : nullptr;
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    (geometry_->kept() ? store_ : compute_)(a_, geometry_->lists(begin, end));
  }

 private:
  std::shared_ptr<PairGeometry> geometry_;
  Field<Real>* volume_ = nullptr;
  Field<Real>* heat_ = nullptr;
  Field<Real>* viscous_speed_ = nullptr;
  std::array<Field<Real>*, 6> strain_{};
  Real q2_ = 0;
  PairLoop compute_, store_;
  PairArrays a_{};
};

/// Keeps what pair loops read of neighbours besides x, v, m and p: while threads work on the rates, density
/// and sound speed already change.
class PairFactors : public Motion, public Refresh {
 public:
  PairFactors(const SphSettings& s, World& world) : q_(s.q), volume_(sph_fields::volume(world.particles)) {
    if (std::holds_alternative<MonaghanViscosity>(s.viscosity))
      viscous_speed_ = &sph_fields::viscous_speed(world.particles);
  }
  std::string name() const override { return "sph factors"; }
  void block(World& world, const Clock&, Index begin, Index end) override {
    const Particles& p = world.particles;
    const Real *m = p.m.data(), *rho = p.rho.data(), *c = p.c.data();
    Real* V = volume_.data();
    for (Index i = begin; i < end; ++i) V[i] = m[i] / rho[i];
    if (!viscous_speed_) return;
    Real* qc = viscous_speed_->data();
    for (Index i = begin; i < end; ++i) qc[i] = q_[p.part[i]].q1 * c[i];
  }
  void refreshed(World& world, const Clock& clock, std::span<const Index>) override {
    for_each_block(world.particles.moving, [&](Index begin, Index end) { block(world, clock, begin, end); });
  }

 private:
  std::vector<PartViscosity> q_;
  Field<Real>& volume_;
  Field<Real>* viscous_speed_ = nullptr;
};

}  // namespace

std::shared_ptr<Rate> make_rates(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry) {
  auto factors = std::make_shared<PairFactors>(s, world);
  world.motions.push_back(factors);
  world.refreshes.push_back(factors);
  return std::make_shared<PairRates>(s, world, std::move(geometry));
}

}  // namespace courant
