#include <algorithm>
#include <cmath>

#include "sph/fields.hpp"
#include "sph/pair_geometry.hpp"
#include "sph/pair_volumes.hpp"
#include "sph/sph.hpp"
#include "sph/view.hpp"
#include "state/keeper.hpp"

namespace courant {

namespace {

/// Continuity, and what else needs the velocities of neighbours: Monaghan's viscosity and the velocity
/// gradient.
class PairRates : public Rate, public Keeper {
 public:
  PairRates(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry,
            std::shared_ptr<PairVolumes> volumes)
      : geometry_(std::move(geometry)), volumes_(std::move(volumes)) {
    if (s.kernel != KernelChoice::cubic_spline) name_ += std::string(", ") + kernel_name(s.kernel);
    Particles& p = world.particles;
    const bool viscous = std::holds_alternative<MonaghanViscosity>(s.viscosity), gradient = !s.mu.empty();
    heat_ = &sph_fields::dissipation(p);
    if (viscous) {
      viscous_speed_ = &sph_fields::viscous_speed(p);
      q2_ = std::get<MonaghanViscosity>(s.viscosity).q2;
    }
    if (gradient) strain_ = &sph_fields::strain_rate(p);
    RatesChoice choice{s.dim, s.uniform_h, viscous, gradient, Geometry::compute, s.kernel};
    compute_ = rates_loop(choice);
    choice.geometry = Geometry::store;
    store_ = rates_loop(choice);
    choice.geometry = Geometry::load;
    load_ = rates_loop(choice);
  }
  std::string name() const override { return name_; }

  void start(World& world, const Clock& clock) override {
    geometry_->prepare();
    loop_ = !geometry_->kept() ? compute_ : geometry_->take_valid() ? load_ : store_;
    if (loop_ == store_ && geometry_->watches_motion()) note_places(world.particles);
    take_arrays(world.particles);
    a_.half_step = geometry_->watches_motion() ? 0 : 0.5 * clock.dt_old;
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    loop_(a_, geometry_->lists(begin, end));
  }

  void keep(Archive& archive) override {
    geometry_->keep(archive);
    if (!geometry_->valid()) return;
    for (int k = 0; k < 3; ++k) archive(std::string("stored_") + "xyz"[k], stored_x_[k]);
  }
  // The loop that stores gradients, once more at the places of then; what else it works out is not wanted.
  void loaded(World& world) override {
    if (!geometry_->valid()) return;
    Particles& p = world.particles;
    exchange_places(world);
    geometry_->prepare();
    take_arrays(p);
    std::vector<Array<Real>> unwanted(11, Array<Real>(p.active, 0.0));
    for (int k = 0; k < 3; ++k) a_.f[k] = unwanted[k].data();
    a_.drhodt = unwanted[3].data(), a_.heat = unwanted[4].data();
    for (int k = 0; k < 6; ++k) a_.strain[k] = strain_ ? unwanted[5 + k].data() : nullptr;
    a_.half_step = 0;
    for_each_block(p.active, [&](Index begin, Index end) { store_(a_, geometry_->lists(begin, end)); });
    exchange_places(world);
  }

 private:
  void take_arrays(Particles& p) {
    a_ = particle_arrays(p);
    a_.V = volumes_->current();
    a_.qc = viscous_speed_ ? viscous_speed_->data() : nullptr;
    a_.heat = heat_->data();
    a_.q2 = q2_;
    for (int k = 0; k < 6; ++k) a_.strain[k] = strain_ ? strain_->data(k) : nullptr;
  }
  void note_places(const Particles& p) {
    for (int k = 0; k < 3; ++k) {
      stored_x_[k].resize(p.moving);
      for_each_block(p.moving, [&](Index begin, Index end) {
        std::copy(p.x.data(k) + begin, p.x.data(k) + end, stored_x_[k].data() + begin);
      });
    }
  }
  /// Moving particles and their images are where gradients were stored, or back.
  void exchange_places(World& world) {
    for (int k = 0; k < 3; ++k)
      std::swap_ranges(stored_x_[k].begin(), stored_x_[k].end(), world.particles.x.data(k));
    for (const auto& e : world.exchangers) e->before_rates(world);
  }

  std::string name_ = "sph rates";
  std::shared_ptr<PairGeometry> geometry_;
  std::shared_ptr<PairVolumes> volumes_;
  Field<Real>* heat_ = nullptr;
  Field<Real>* viscous_speed_ = nullptr;
  Field<Real>* strain_ = nullptr;
  Real q2_ = 0;
  PairLoop compute_, store_, load_, loop_ = nullptr;
  PairArrays a_{};
  Array<Real> stored_x_[3];  ///< where gradients that are kept over steps were worked out [L]
};

/// Keeps q1 c as pair loops read it of neighbours: while threads work on the rates, the sound speed already
/// changes. Watches how long gradients that are kept over steps hold.
class PairFactors : public Motion, public Refresh, public Keeper {
 public:
  PairFactors(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry)
      : geometry_(std::move(geometry)), q_(s.q) {
    if (!std::holds_alternative<BulkViscosity>(s.viscosity))
      viscous_speed_ = &sph_fields::viscous_speed(world.particles);
  }
  std::string name() const override { return "sph factors"; }
  void start(World& world, const Clock& clock) override {
    const Particles& p = world.particles;
    expires_ = geometry_->will_expire(p.active > 0 ? p.h[0] : 1, clock.dt);
    if (geometry_->watches_motion()) fastest2_.assign(block_count(p.moving), 0);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    update(world, begin, end);
    if (!geometry_->watches_motion()) return;
    const Particles& p = world.particles;
    const Real *vx = p.v.data(0), *vy = p.v.data(1), *vz = p.v.data(2);
    Real most = 0;
#pragma omp simd reduction(max : most)
    for (Index i = begin; i < end; ++i) most = std::max(most, vx[i] * vx[i] + vy[i] * vy[i] + vz[i] * vz[i]);
    fastest2_[begin / block_size] = most;
  }
  void finish(World&, const Clock& clock) override {
    if (!geometry_->watches_motion()) return geometry_->expire();
    Real most = 0;
    for (const Real v2 : fastest2_) most = std::max(most, v2);
    geometry_->moved(std::sqrt(most), clock.dt, expires_);
  }
  void refreshed(World& world, const Clock&, std::span<const Index>) override {
    loaded(world);
    geometry_->expire();
  }
  void keep(Archive&) override {}
  void loaded(World& world) override {
    for_each_block(world.particles.moving, [&](Index begin, Index end) { update(world, begin, end); });
  }

 private:
  void update(World& world, Index begin, Index end) {
    if (!viscous_speed_) return;
    const Particles& p = world.particles;
    const Real* c = p.c.data();
    Real* qc = viscous_speed_->data();
    for (Index i = begin; i < end; ++i) qc[i] = q_[p.part[i]].q1 * c[i];
  }

  std::shared_ptr<PairGeometry> geometry_;
  bool expires_ = true;
  std::vector<Real> fastest2_;  ///< in each block [L2/T2]
  std::vector<PartViscosity> q_;
  Field<Real>* viscous_speed_ = nullptr;
};

}  // namespace

std::shared_ptr<Rate> make_rates(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry,
                                 std::shared_ptr<PairVolumes> volumes) {
  auto factors = std::make_shared<PairFactors>(s, world, geometry);
  world.motions.push_back(factors);
  world.refreshes.push_back(factors);
  return std::make_shared<PairRates>(s, world, std::move(geometry), std::move(volumes));
}

}  // namespace courant
