// MU between pairs, beside walls that hold water fast (LAW 2 of *COURANT_WALL_SUPPORT).
#include <algorithm>
#include <cmath>

#include "loads/middle_velocity.hpp"
#include "parallel/parallel.hpp"
#include "search/neighbours.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"
#include "sph/options/pair_viscosity_loops.hpp"
#include "sph/sph.hpp"

namespace courant {

namespace {

/// Takes the position of the viscous stress, which does not see velocities that change from row to row: where
/// a wall holds the lowest row, rows pair off. Heat is that of the velocities before the kick; what the kick
/// changes of it, by the force of walls, too, is added behind it; particles that are driven it does not
/// change.
class PairViscosity : public Rate, public EnergyTerm {
 public:
  PairViscosity(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                std::shared_ptr<PairVolumes> volumes)
      : loop_(pair_viscosity_loop(s.kernel, s.dim, s.uniform_h)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)),
        viscosity_(sph_fields::viscosity(world.particles)),
        heat_(sph_fields::viscous_dissipation(world.particles)),
        force_(sph_fields::viscous_force(world.particles)) {
    force_.fill(0);  // loops in the plane leave z alone
    a_.kernel = &any_kernel(s.kernel);
    Particles& p = world.particles;
    for (Index i = 0; i < p.size(); ++i) viscosity_[i] = s.mu[static_cast<std::size_t>(p.part[i])];
  }
  std::string name() const override { return "viscosity between pairs"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x, Reach::others).reads(p.v, Reach::others).reads(p.h, Reach::others);
    a.reads(volumes_->before(), Reach::others).reads(viscosity_, Reach::others);
    a.updates(p.f).writes(heat_).writes(force_);
  }
  void start(World& world, const Clock&) override {
    Particles& p = world.particles;
    for (int c = 0; c < 3; ++c) a_.x[c] = p.x.data(c), a_.v[c] = p.v.data(c), a_.f[c] = force_.data(c);
    a_.h = p.h.data(), a_.V = volumes_->current();
    a_.mu = viscosity_.data(), a_.heat = heat_.data();
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (int c = 0; c < 3; ++c) std::fill(a_.f[c] + begin, a_.f[c] + end, 0);
    loop_(a_, lists_of(*neighbours_, begin, end));
    for (int c = 0; c < 3; ++c) {
      Real* f = world.particles.f.data(c);
      for (Index i = begin; i < end; ++i) f[i] += a_.f[c][i];
    }
  }
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    Particles& p = world.particles;
    const Points points = points_of(p);
    const MiddleVelocity middle(points, clock);
    const Real power = sum(p.active, [&](Index i) { return force_.vec(i).dot(p.v.vec(i) - middle(i)); });
    ledger.dissipated += power * clock.dt_mean();
    ledger.throughput += std::abs(power) * clock.dt_mean();
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  PairViscosityLoop loop_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  Field<Real>&viscosity_, &heat_, &force_;
  PairViscosityArrays a_{};
};

}  // namespace

void add_pair_viscosity(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                        std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(std::make_shared<PairViscosity>(s, world, std::move(neighbours), std::move(volumes)));
}

}  // namespace courant
