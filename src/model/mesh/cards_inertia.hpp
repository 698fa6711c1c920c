#pragma once
#include "keyword/card.hpp"
#include "model/mesh/mesh_cards.hpp"

namespace courant {

/// *ELEMENT_INERTIA, _OFFSET
struct ElementInertiaCard : ElementInertiaCardFields {
  Matrix inertia() const {
    Matrix out;
    out << ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz;
    return out;
  }
};

}  // namespace courant
