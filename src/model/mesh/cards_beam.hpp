#pragma once
#include "keyword/card.hpp"

namespace courant {

/// *ELEMENT_BEAM, _THICKNESS, _ORIENTATION and both.
struct ElementBeamCard : Entry {
  Id eid = 0, pid = 0, n1 = 0, n2 = 0, n3 = 0;
  int rt1 = 0, rr1 = 0, rt2 = 0, rr2 = 0, local = 2;
  Real parm1 = 0, parm2 = 0, parm3 = 0, parm4 = 0, parm5 = 0;
  Real vx = 0, vy = 0, vz = 0;
  bool has_thickness() const { return name == 1 || name == 3; }
  bool has_orientation() const { return name == 2 || name == 3; }
};

}  // namespace courant
