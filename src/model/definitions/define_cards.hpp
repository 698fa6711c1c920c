#pragma once
// Cards of tables, local boxes, coordinate systems and vectors.
#include <string>
#include <vector>

#include "keyword/card.hpp"

namespace courant {

struct DefineBoxLocalCard : Entry {
  std::string title;
  Id boxid = 0;
  Real xmn = 0, xmx = 0, ymn = 0, ymx = 0, zmn = 0, zmx = 0;
  Real xx = 0, yx = 0, zx = 0, xv = 0, yv = 0, zv = 0, cx = 0, cy = 0, cz = 0;
};

struct CoordinateSystemCard : Entry {
  std::string title;
  Id cid = 0, cidl = 0;
  Real xo = 0, yo = 0, zo = 0, xl = 0, yl = 0, zl = 0, xp = 0, yp = 0, zp = 0;
  int type = 0;
};

struct CoordinateNodesCard : Entry {
  std::string title;
  Id cid = 0, n1 = 0, n2 = 0, n3 = 0;
  int flag = 0, type = 0;
  std::string dir;
};

struct CoordinateVectorCard : Entry {
  std::string title;
  Id cid = 0, nid = 0;
  Real xx = 0, yx = 0, zx = 0, xv = 0, yv = 0, zv = 0;
};

struct DefineVectorCard : Entry {
  std::string title;
  Id vid = 0, cid = 0;
  Real xt = 0, yt = 0, zt = 0, xh = 0, yh = 0, zh = 0;
};

struct DefineVectorNodesCard : Entry {
  std::string title;
  Id vid = 0, nodet = 0, nodeh = 0;
};

struct DefineTableCard : Entry {  ///< the curves are those that follow in the deck
  std::string title;
  Id tbid = 0;
  Real sfa = 1, offa = 0;
  std::vector<Real> value;
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
