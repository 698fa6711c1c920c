#pragma once
// The thickness with which contacts that are not tied count shells.
#include "state/shared_fields.hpp"
#include "state/world.hpp"

namespace courant {

/// Of a face of a shell: OPTT or SFT of *PART_CONTACT, or its own. [L]
inline Real contact_thickness(const Segments& g, Index s) {
  const Field<Real>* own = shared_fields::contact_thickness.find(g.fields);
  return own && (*own)[s] > 0 ? (*own)[s] : g.thickness[s];
}

}  // namespace courant
