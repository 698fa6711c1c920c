#pragma once
// Fields that several SPH passes share, each described in one place. A field exists once a pass asks for it.
#include "state/entities.hpp"

namespace courant::sph_fields {

/// Symmetric velocity gradient: xx yy zz xy yz zx
inline Field<Real>& strain_rate(Particles& p) {
  return p.fields.add<Real>({.name = "strain_rate", .dimension = "1/T", .components = 6, .restart = false});
}
/// Viscous stress: xx yy zz xy yz zx
inline Field<Real>& stress(Particles& p) {
  return p.fields.add<Real>({.name = "stress",
                             .dimension = "M/LT2",
                             .components = 6,
                             .restart = false,
                             .exchange = Exchange::before_forces});
}

/// q1 c at the last motion
inline Field<Real>& viscous_speed(Particles& p) {
  return p.fields.add<Real>(
      {.name = "viscous_speed", .dimension = "L/T", .restart = false, .exchange = Exchange::before_rates});
}
/// p + q of the bulk viscosity
inline Field<Real>& pressure_plus_q(Particles& p) {
  return p.fields.add<Real>({.name = "pressure_plus_q",
                             .dimension = "M/LT2",
                             .restart = false,
                             .exchange = Exchange::before_forces});
}
/// Rate of density by diffusion, of the last forces: the next rates take it.
inline Field<Real>& density_diffusion(Particles& p) {
  return p.fields.add<Real>({.name = "density_diffusion", .dimension = "M/L3T"});
}
/// -g.x of gravity; images have that of their particle, as they have its pressure.
inline Field<Real>& potential(Particles& p) {
  return p.fields.add<Real>(
      {.name = "potential", .dimension = "L2/T2", .restart = false, .exchange = Exchange::before_rates});
}
/// Power that artificial viscosity turns into heat
inline Field<Real>& dissipation(Particles& p) {
  return p.fields.add<Real>({.name = "dissipation", .dimension = "ML2/T3"});
}
/// Power that MU turns into heat
inline Field<Real>& viscous_dissipation(Particles& p) {
  return p.fields.add<Real>({.name = "viscous_dissipation", .dimension = "ML2/T3"});
}

}  // namespace courant::sph_fields
