#pragma once
#include "sph/fields.hpp"
#include "sph/sph.hpp"

namespace courant {

/// Adds to the rate of density what no motion of particles makes [M/L3T]. The work that pressure does by it
/// on the internal energy is not done on anything: it counts as dissipated.
class DensitySource {
 public:
  /// `first`: of several in a scene.
  DensitySource(const SphSettings& s, World& world, bool first)
      : first_(first && !std::holds_alternative<MonaghanViscosity>(s.viscosity)),
        heat_(sph_fields::dissipation(world.particles)) {}
  void add(Particles& p, const Real* source, Index begin, Index end) {
    const Real *rho = p.rho.data(), *m = p.m.data(), *pressure = p.p.data();
    Real *rate = p.drhodt.data(), *heat = heat_.data();
    for (Index i = begin; i < end; ++i) {
      rate[i] += source[i];
      heat[i] = (first_ ? 0 : heat[i]) - pressure[i] * m[i] / (rho[i] * rho[i]) * source[i];
    }
  }

 private:
  bool first_;  ///< to give heat: bulk viscosity comes later
  Field<Real>& heat_;
};

}  // namespace courant
