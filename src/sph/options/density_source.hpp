#pragma once
#include <algorithm>

#include "sph/core/fields.hpp"
#include "sph/sph.hpp"

namespace courant {

/// Adds to the rate of density what no motion of particles makes [M/L3T]. The work that pressure does by it
/// on the internal energy is not done on anything: it counts as dissipated.
class DensitySource {
 public:
  /// `first`: of several in a scene.
  DensitySource(const SphSettings& s, World& world, bool first)
      : first_(first), heat_(sph_fields::dissipation(world.particles)) {
    if (!std::holds_alternative<BulkViscosity>(s.viscosity)) return;
    bulk_ = &sph_fields::bulk_dissipation(world.particles);
    sources_ = &sph_fields::density_sources(world.particles);
  }
  /// `step`: over which the source acts, for sources that change much in one step: the pressure is then that
  /// of its middle, as the rates so far foretell it, and the change of m/rho exact; 0: those at its start.
  void add(Particles& p, const Real* source, Index begin, Index end, Real step = 0) {
    const Real *rho = p.rho.data(), *m = p.m.data(), *pressure = p.p.data(), *c = p.c.data();
    Real *rate = p.drhodt.data(), *heat = heat_.data();
    if (first_) none(begin, end);
    for (Index i = begin; i < end; ++i) {
      rate[i] += source[i];
      const Real change = rate[i] * step;
      if (sources_) (*sources_)[i] += source[i];
      heat[i] -= (pressure[i] + 0.5 * c[i] * c[i] * change) * m[i] / (rho[i] * (rho[i] + change)) * source[i];
    }
  }
  /// `with_step`: whether `add` is given one.
  void declare(const Particles& p, Accesses& a, bool with_step = false) const {
    a.reads_before(p.rho).reads(p.m).reads_before(p.p).reads_before(p.c);
    if (with_step)
      a.revises(p.drhodt);
    else
      a.updates(p.drhodt);
    if (first_ && bulk_)
      a.writes(heat_).writes(*sources_).reads(*bulk_);
    else
      a.updates(heat_);
    if (!first_ && sources_) a.updates(*sources_);
  }
  /// The same for no source. Bulk viscosity's heat of this step is not known yet: the equation of state takes
  /// that of the step before, with the sources' of this one.
  void none(Index begin, Index end) {
    if (!first_ || !bulk_) return;
    std::copy(bulk_->data() + begin, bulk_->data() + end, heat_.data() + begin);
    std::fill(sources_->data() + begin, sources_->data() + end, 0.0);
  }

 private:
  bool first_;
  Field<Real>& heat_;
  Field<Real>*bulk_ = nullptr, *sources_ = nullptr;  ///< beside bulk viscosity
};

}  // namespace courant
