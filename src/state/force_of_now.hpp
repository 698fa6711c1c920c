#pragma once
#include "state/entities.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace shared_fields {
/// Particles, with sub-cycling (state/subcycle.hpp): the force where slow forces count as they are, not as
/// the kick of the step that Particles::f has. [ML/T2]
inline const SharedField<Real> force_of_now{
    {.name = "force_of_now", .dimension = "ML/T2", .components = 3, .restart = false}};
}  // namespace shared_fields

/// The forces of accelerations in results. [ML/T2]
inline const Field<Real>& force_of_now(const Particles& p) {
  const Field<Real>* const known = shared_fields::force_of_now.find(p.fields);
  return known ? *known : p.f;
}

}  // namespace courant
