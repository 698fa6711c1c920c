#pragma once
#include "keyword/card.hpp"

namespace courant {

struct SectionBeam : Entry {
  std::string title;
  std::string stype;                                    ///< "SECTION_01" ...; empty: measures are given
  Real d1 = 0, d2 = 0, d3 = 0, d4 = 0, d5 = 0, d6 = 0;  ///< of the standard section
  Id secid = 0;
  int elform = 1, naupd = 0;
  Real shrf = 1, rule = 2, cst = 0, scoor = 0, nsm = 0;
  Real ts1 = 0, ts2 = 0, tt1 = 0, tt2 = 0, nsloc = 0, ntloc = 0;                ///< ELFORM 1, 9
  Real print = 0, itoff = 0;                                                    ///< 9
  Real a = 0, iss = 0, itt = 0, j = 0, sa = 0, ist = 0;                         ///< 2; a: also 3
  Real rampt = 0, stress = 0;                                                   ///< 3
  Real vol = 0, iner = 0, ca = 0, offset = 0, rrcon = 0, srcon = 0, trcon = 0;  ///< 6
  Id cid = 0;
  /// The formulation that is used: 1, 2, 3, 6; 0: none.
  int used() const {
    if (elform == 1 || elform == 4 || elform == 5 || elform == 9) return 1;
    if (elform == 2 || elform == 13) return 2;
    return elform == 3 || elform == 6 ? elform : 0;
  }
  bool weld() const { return elform == 9; }
  bool tube() const { return cst == 1 || elform == 5 || weld(); }
};

}  // namespace courant
