#pragma once
// Cards of tables, local boxes, coordinate systems and vectors.
#include <string>
#include <vector>

#include "keyword/card.hpp"
#include "model/definitions/definition_cards.hpp"

namespace courant {

struct CoordinateSystemCard : Entry {
  std::string title;
  Id cid = 0, cidl = 0;
  Real xo = 0, yo = 0, zo = 0, xl = 0, yl = 0, zl = 0, xp = 0, yp = 0, zp = 0;
  int type = 0;
};

struct DefineVectorCard : Entry {
  std::string title;
  Id vid = 0, cid = 0;
  Real xt = 0, yt = 0, zt = 0, xh = 0, yh = 0, zh = 0;
};

struct DefineTable2dCard : Entry {
  std::string title;
  Id tbid = 0;
  Real sfa = 1, offa = 0;
  std::vector<Real> value;
  std::vector<Id> curveid;
};
struct DefineTable3dCard : DefineTable2dCard {};

}  // namespace courant
