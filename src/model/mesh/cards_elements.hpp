#pragma once
// Solid elements, and what goes for all of them.
#include "keyword/card.hpp"

namespace courant {

struct ElementSolidCard : Entry {
  Id eid = 0, pid = 0;
  Id n1 = 0, n2 = 0, n3 = 0, n4 = 0, n5 = 0, n6 = 0, n7 = 0, n8 = 0, n9 = 0, n10 = 0;
  Real a1 = 0, a2 = 0, a3 = 0, d1 = 0, d2 = 0, d3 = 0;  ///< _ORTHO: directions of the material
};

struct ControlSolid : Entry {
  int esort = 0, fmatrix = 0, niptets = 0, swlocl = 0;
  Id psfail = 0;
  Real t10jtol = 0;
  int icoh = 0, tet13k = 0;
  int pm1 = 0, pm2 = 0, pm3 = 0, pm4 = 0, pm5 = 0, pm6 = 0, pm7 = 0, pm8 = 0, pm9 = 0, pm10 = 0;
  int tet13v = 0;
};

}  // namespace courant
