// The heat of Monaghan's viscosity, as equations of state take it into E.
#include "sph/core/fields.hpp"
#include "sph/core/pair_motion.hpp"
#include "sph/materials/materials.hpp"
#include "state/restartable.hpp"

namespace courant {

namespace {

/// F^n, made of v^{n-1/2}, acts in the kick from there to v^{n+1/2}: half of it takes energy from the
/// velocities before, half from those behind. So the step whose velocities are v^{n-1/2} gets half of what
/// F^n takes from them, and half of what F^{n-1} does. With all of F^n the energy of shocks does not close:
/// velocities change much within a step there. What F^{n-1} takes from the change of velocities is reported
/// by the force on each particle, whose sum is that of pairs.
class ViscousHeat : public Rate, public Refresh {
 public:
  explicit ViscousHeat(World& world)
      : motion_(world.particles),
        power_(sph_fields::dissipation(world.particles)),
        heat_(sph_fields::viscous_heat(world.particles)),
        force_(sph_fields::last_viscous_force(world.particles)),
        taken_(sph_fields::last_viscous_power(world.particles)) {
    force_.fill(0), taken_.fill(0);
  }
  std::string name() const override { return "viscous heat"; }
  void declare(const World&, Accesses& a) const override {
    a.reads(motion_.f).reads(motion_.v).reads(power_).writes(heat_).updates(force_).updates(taken_);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index i = begin; i < end; ++i) {  // f holds nothing else yet
      const Vec v = motion_.v.vec(i), f = motion_.f.vec(i);
      heat_[i] = 0.5 * (power_[i] + taken_[i] - force_.vec(i).dot(v));
      taken_[i] = power_[i] + f.dot(v);
      force_.set(i, f);
    }
  }
  /// No force acts on particles that are not active.
  void refreshed(World& world, const Clock&, std::span<const Index>) override {
    const Particles& p = world.particles;
    for (Index i = p.active; i < p.size(); ++i) force_.set(i, Vec::Zero()), taken_[i] = 0;
  }

 private:
  PairMotion motion_;
  Field<Real>&power_, &heat_, &force_, &taken_;
};

}  // namespace

const Field<Real>& add_viscous_heat(const SphSettings& s, World& world) {
  if (!std::holds_alternative<MonaghanViscosity>(s.viscosity) || s.has_viscous_pairs() ||
      s.has_density_sources())
    return sph_fields::dissipation(world.particles);
  world.passes.add(std::make_shared<ViscousHeat>(world));
  return sph_fields::viscous_heat(world.particles);
}

}  // namespace courant
