#pragma once
#include "keyword/card.hpp"

namespace courant {

/// *DEFINE_SPH_INJECTION
struct DefineSphInjection : Entry {
  std::string title;
  Id pid = 0, nsid = 0, cid = 0, vmag = 0, nid = 0;
  Real vx = 0, vy = 0, vz = 0, area = 0, tbeg = 0, tend = 0, radius = 0, xlen = 0, ylen = 0, psize = 0;
};

/// *DEFINE_SPH_INJECTION_SIMPLIFIED
struct DefineSphInjectionSimplified : Entry {
  std::string title;
  Id pid = 0, cid = 0, nid = 0;
  Real vel = 0;  ///< of _FLOWRATE: volume per time [L3/T]
  Real radius = 0, psize = 0, offst = 0, xc = 0, yc = 0, zc = 0, dnx = 0, dny = 0, dnz = 0, tbeg = 0,
       tend = 0;
};
struct DefineSphInjectionFlowrate : DefineSphInjectionSimplified {};

}  // namespace courant
