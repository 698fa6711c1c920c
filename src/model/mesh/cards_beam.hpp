#pragma once
#include "model/mesh/mesh_cards.hpp"

namespace courant {

/// *ELEMENT_BEAM, _THICKNESS, _ORIENTATION and both.
struct ElementBeamCard : ElementBeamFields {
  bool has_thickness() const { return name == 1 || name == 3; }
  bool has_orientation() const { return name == 2 || name == 3; }
};

}  // namespace courant
