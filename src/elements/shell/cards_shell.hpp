#pragma once
#include "keyword/card.hpp"

namespace courant {

/// *CONTROL_SHELL: options of shells that deform.
struct ControlShell : Entry {
  Real wrpang = 20, rotascl = 1, wmode = 0, stretch = 0, drcprm = 1;
  int esort = 0, irnxx = -1, istupd = 0, theory = 2, bwc = 2, miter = 1, proj = 0, intgrd = 0, lamsht = 0,
      cstyp6 = 1, tshell = 0, sidt4tu = 0, cntco = 0, itsflg = 0, irquad = 3, icrq = 0, nfail1 = 0,
      nfail4 = 0, keepcs = 0, delfr = 0, intperr = 0, drcmth = 0, nlocdt = 0;
  Id psstupd = 0, psnfail = 0, drcpsid = 0, lispsid = 0;
};

/// *CONTROL_ACCURACY: INN tells how the axes of shells lie in them.
struct ControlAccuracy : Entry {
  int osu = 0, inn = 0, iacc = 0;
  Id pidosu = 0;
  Real exacc = 0;
  bool invariant_shells() const { return inn == 2 || inn == 4 || inn == -2 || inn == -4; }
};

}  // namespace courant
