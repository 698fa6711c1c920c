#pragma once
// Cards that choose what the field files hold.
#include <string>
#include <vector>

#include "keyword/card.hpp"
#include "model/requests/request_cards.hpp"

namespace courant {

struct DatabaseExtentBinary : Entry {
  std::string intout, nodout;
  int neiph = 0, neips = 0, maxint = 0, strflg = 0, sigflg = 0, epsflg = 0, rltflg = 0, engflg = 0,
      cmpflg = 0, ieverp = 0, beamip = 0, dcomp = 0, shge = 0, stssz = 0, n3thdt = 0, ialemat = 0,
      nintsld = 0, pkp_sen = 0, hydro = 0, msscl = 0, therm = 0, dtdt = 0, resplt = 0, neipb = 0, quadsld = 0,
      cubsld = 0, deleres = 0;
  Real sclp = 0;
};

}  // namespace courant
