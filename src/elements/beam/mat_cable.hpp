#pragma once
#include "keyword/deck.hpp"

namespace courant {

/// *MAT_CABLE_DISCRETE_BEAM
struct MatCableDiscreteBeam : Entry {
  std::string title;
  Id mid = 0, lcid = 0;
  Real ro = 0, e = 0, f0 = 0, tmaxf0 = 0, tramp = 0, tstart = 0, fracl0 = 0, mxeps = 1e20, mxfrc = 1e20;
  int iread = 0, output = 0;
};

}  // namespace courant
