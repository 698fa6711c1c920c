#pragma once
#include <algorithm>

#include "sph/fields.hpp"
#include "sph/sph.hpp"

namespace courant {

/// Adds to the rate of density what no motion of particles makes [M/L3T]. The work that pressure does by it
/// on the internal energy is not done on anything: it counts as dissipated.
class DensitySource {
 public:
  /// `first`: of several in a scene.
  DensitySource(const SphSettings& s, World& world, bool first)
      : first_(first && std::holds_alternative<BulkViscosity>(s.viscosity)),
        heat_(sph_fields::dissipation(world.particles)) {}
  /// `step`: over which the source acts, for sources that change much in one step: the pressure is then that
  /// of its middle, as the rates so far foretell it, and the change of m/rho exact; 0: those at its start.
  void add(Particles& p, const Real* source, Index begin, Index end, Real step = 0) {
    const Real *rho = p.rho.data(), *m = p.m.data(), *pressure = p.p.data(), *c = p.c.data();
    Real *rate = p.drhodt.data(), *heat = heat_.data();
    for (Index i = begin; i < end; ++i) {
      rate[i] += source[i];
      const Real change = rate[i] * step;
      heat[i] = (first_ ? 0 : heat[i]) -
                (pressure[i] + 0.5 * c[i] * c[i] * change) * m[i] / (rho[i] * (rho[i] + change)) * source[i];
    }
  }
  /// The same for no source.
  void none(Index begin, Index end) {
    if (first_) std::fill(heat_.data() + begin, heat_.data() + end, 0.0);
  }

 private:
  bool first_;  ///< to give heat: bulk viscosity comes later
  Field<Real>& heat_;
};

}  // namespace courant
