// *COURANT_DENSITY_DIFFUSION: evens out the noise of pressures (delta-SPH).
#include "keyword/registry.hpp"
#include "parallel/parallel.hpp"
#include "sph/cards.hpp"
#include "sph/core/fields.hpp"
#include "sph/options/density_source.hpp"
#include "sph/options/option_cards.hpp"
#include "sph/sph.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantDensityDiffusion> density_diffusion_keyword{courant_density_diffusion_table()};

/// d rho/dt += D with the D that the forces of the step before worked out beside the pressure: they know the
/// pressures of neighbours, which change while rates are worked out. A Riemann flux takes much in one step.
class DensityDiffusion : public Rate {
 public:
  DensityDiffusion(const SphSettings& s, World& world)
      : riemann_(std::holds_alternative<RiemannFlux>(s.viscosity)),
        source_(s, world, true),
        rate_(sph_fields::density_diffusion(world.particles)) {}
  std::string name() const override { return riemann_ ? "Riemann flux (density)" : "density diffusion"; }
  void declare(const World& world, Accesses& a) const override {
    source_.declare(world.particles, a, riemann_);
    a.reads(rate_);
  }
  void block(World& world, const Clock& clock, Index begin, Index end) override {
    source_.add(world.particles, rate_.data(), begin, end, riemann_ ? clock.dt_old : 0);
  }

 private:
  bool riemann_;
  DensitySource source_;
  Field<Real>& rate_;
};

/// The potential of body loads as pair loops read it of neighbours.
class LoadPotential : public Preparation, public Refresh {
 public:
  LoadPotential(const SphSettings& s, World& world)
      : loads_(s.loads), potential_(sph_fields::potential(world.particles)) {}
  std::string name() const override { return "potential of body loads"; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.particles.x).writes(potential_);
    if (!loads_.uniform()) a.reads(world.particles.part);
  }
  void start(World&, const Clock& clock) override { now_ = loads_.at(clock.t + clock.dt); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    const Field<Real>& x = world.particles.x;
    if (loads_.uniform()) {
      const Vec g = now_.everywhere();
      for (Index i = begin; i < end; ++i) potential_[i] = -g.dot(x.vec(i));
    } else {
      for (Index i = begin; i < end; ++i) potential_[i] = now_.potential(x.vec(i), world.particles.part[i]);
    }
  }
  void refreshed(World& world, const Clock& clock, std::span<const Index>) override {
    now_ = loads_.at(clock.t);
    for_each_block(world.particles.moving, [&](Index begin, Index end) { block(world, clock, begin, end); });
  }

 private:
  BodyAcceleration loads_;
  BodyAcceleration::At now_;
  Field<Real>& potential_;
};

}  // namespace

void add_density_diffusion(const SphSettings& s, World& world) {
  world.passes.add(std::make_shared<DensityDiffusion>(s, world));
  world.passes.add(std::make_shared<LoadPotential>(s, world));
}

}  // namespace courant
