#pragma once
#include "keyword/deck.hpp"

namespace courant {

/// *MAT_RIGID; units as in the keyword's table
struct MatRigid : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, E = 0, pr = 0, n = 0, couple = 0, m = 0;
  std::string alias;
  Real cmo = 0, con1 = 0, con2 = 0, xspc = 0, yspc = 0, zspc = 0;
  Id spcnid = 0;
  Real lco = 0, a2 = 0, a3 = 0, v1 = 0, v2 = 0, v3 = 0;
  int bndlco = 0;
};

/// The one of this id; null where there is none.
const MatRigid* mat_rigid_of(const Deck& deck, Id mid);

}  // namespace courant
