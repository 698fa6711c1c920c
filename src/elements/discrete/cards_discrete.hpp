#pragma once
#include "keyword/card.hpp"

namespace courant {

struct ElementDiscreteCard : Entry {
  Id eid = 0, pid = 0, n1 = 0, n2 = 0, vid = 0;
  Real s = 1, offset = 0;
  int pf = 0;
};

struct SectionDiscrete : Entry {
  std::string title;
  Id secid = 0;
  int dro = 0;
  Real kd = 0, v0 = 0, cl = 0, fd = 0, cdl = 0, tdl = 0;
  bool turns() const { return dro == 1; }
};

/// *DEFINE_SD_ORIENTATION: along which direction springs act instead of that between their ends.
struct SdOrientation : Entry {
  std::string title;
  Id vid = 0, nid1 = 0, nid2 = 0;
  int iop = 0;
  Real xt = 0, yt = 0, zt = 0;
};

/// *ELEMENT_MASS; with `of_set` *ELEMENT_MASS_NODE_SET, which gives each node of a set that mass.
struct ElementMassCard : Entry {
  Id eid = 0, nid = 0, pid = 0;
  Real mass = 0;
};
struct ElementMassSetCard : ElementMassCard {};

}  // namespace courant
