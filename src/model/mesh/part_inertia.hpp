#pragma once
#include "model/cards.hpp"

namespace courant {

/// *PART_INERTIA; units as in the keyword's table
struct PartInertiaCard : PartCard {
  Real xc = 0, yc = 0, zc = 0, tm = 0;
  int ircs = 0;
  Id nodeid = 0, cid = 0;
  Real ixx = 0, ixy = 0, ixz = 0, iyy = 0, iyz = 0, izz = 0;
  Real vtx = 0, vty = 0, vtz = 0, vrx = 0, vry = 0, vrz = 0;
  Real xl = 0, yl = 0, zl = 0, xlip = 0, ylip = 0, zlip = 0;
  Matrix inertia() const {
    Matrix out;
    out << ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz;
    return out;
  }
};

/// The tensor and the rates turn with a file that is moved; no reason why they could not.
std::string turn_inertia(PartInertiaCard& card, const Affine& motion);

}  // namespace courant
