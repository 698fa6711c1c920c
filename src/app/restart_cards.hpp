#pragma once
#include "keyword/card.hpp"

namespace courant {

struct DatabaseRunrsfCard : Entry {
  Real cycl = 0;
  int nr = 1, beam = 0, npltc = 0, nskip = 0;
  Id psetid = 0;
};

struct DatabaseD3dumpCard : Entry {
  Real cycl = 0;
  Id lcdt = 0, psetid = 0, cid = 0;
  int beam = 0, npltc = 0, nskip = 0, ioopt = 0;
};

}  // namespace courant
