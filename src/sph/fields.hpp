#pragma once
// Fields that several SPH passes share, each described in one place. A field exists once a pass asks for it.
#include <array>
#include <string>

#include "state/entities.hpp"

namespace courant::sph_fields {

/// Six fields NAME_xx, _yy, _zz, _xy, _yz, _zx.
inline std::array<Field<Real>*, 6> tensor(Particles& p, const std::string& name,
                                          const std::string& dimension) {
  std::array<Field<Real>*, 6> fields{};
  const char* axes[] = {"xx", "yy", "zz", "xy", "yz", "zx"};
  for (int k = 0; k < 6; ++k)
    fields[k] = &p.fields.add<Real>({.name = name + "_" + axes[k], .dimension = dimension, .restart = false});
  return fields;
}
inline std::array<Field<Real>*, 6> strain_rate(Particles& p) {
  return tensor(p, "strain_rate", "1/T");
}
inline std::array<Field<Real>*, 6> stress(Particles& p) {
  return tensor(p, "stress", "M/LT2");
}

/// m/rho at the last motion
inline Field<Real>& volume(Particles& p) {
  return p.fields.add<Real>({.name = "volume", .dimension = "L3", .restart = false, .exchange = true});
}
/// q1 c at the last motion
inline Field<Real>& viscous_speed(Particles& p) {
  return p.fields.add<Real>(
      {.name = "viscous_speed", .dimension = "L/T", .restart = false, .exchange = true});
}
/// p + q of the bulk viscosity
inline Field<Real>& pressure_plus_q(Particles& p) {
  return p.fields.add<Real>({.name = "pressure_plus_q", .dimension = "M/LT2", .restart = false});
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
