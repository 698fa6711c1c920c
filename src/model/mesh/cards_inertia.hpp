#pragma once
#include "keyword/card.hpp"

namespace courant {

/// *ELEMENT_INERTIA, _OFFSET
struct ElementInertiaCard : Entry {
  Id eid = 0, nid = 0, csid = 0;
  Real ixx = 0, ixy = 0, ixz = 0, iyy = 0, iyz = 0, izz = 0, mass = 0;
  Real x_off = 0, y_off = 0, z_off = 0;
  Matrix inertia() const {
    Matrix out;
    out << ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz;
    return out;
  }
};

}  // namespace courant
