#pragma once
#include <vector>

#include "sph/core/fields.hpp"
#include "sph/sph.hpp"

namespace courant {

/// Dynamic viscosity of particles [M/LT]: MU of their part, or where there is an eddy viscosity the field
/// that holds both.
class DynamicViscosity {
 public:
  DynamicViscosity(const SphSettings& s, World& world)
      : mu_(s.mu), both_(s.has_eddies() ? &sph_fields::viscosity(world.particles) : nullptr) {}
  bool none() const { return mu_.empty(); }
  void declare(const Particles& p, Accesses& a) const {
    if (none()) return;
    if (both_)
      a.reads(*both_);
    else
      a.reads(p.part);
  }
  /// Where there is some.
  Real of(const Particles& p, Index i) const { return both_ ? (*both_)[i] : mu_[p.part[i]]; }

 private:
  std::vector<Real> mu_;
  const Field<Real>* both_;
};

}  // namespace courant
