#pragma once
// CNTCO of *CONTROL_SHELL: contact counts the thickness of shells from a plane that is not that of their
// nodes.
#include "state/shared_fields.hpp"
#include "state/world.hpp"

namespace courant {

namespace shared_fields {

/// Faces of shells: height of that plane over the nodes along the normal, in halves of the contact thickness
/// [-] (CNTCO 2), and as a length [L] (CNTCO 1). Only where some have one.
inline const SharedField<Real> contact_offset{
    {.name = "contact_offset", .dimension = "-", .components = 2, .restart = false}};

}  // namespace shared_fields

/// Of a face whose contact thickness is 2 `half`. [L]
inline Real contact_offset(const Segments& g, Index s, Real half) {
  const Field<Real>* field = shared_fields::contact_offset.find(g.fields);
  return field ? field->data(0)[s] * half + field->data(1)[s] : Real(0);
}

}  // namespace courant
