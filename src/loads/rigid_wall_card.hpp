#pragma once
#include <string>

#include "keyword/deck.hpp"

namespace courant {

/// *RIGIDWALL_PLANAR with its options
struct RigidWallPlanar : Entry {
  /// The name tells which cards there are; see wall_names.
  bool finite() const { return name & 1; }
  bool moving() const { return name & 2; }
  bool forces() const { return name & 4; }
  bool display() const { return name & 8; }
  std::string title;
  Id id = 0, nsid = 0, nsidex = 0, boxid = 0, ssid = 0, n1 = 0, n2 = 0, n3 = 0, n4 = 0, pid = 0;
  Real offset = 0, birth = 0, death = 1e20, rwksf = 1, xt = 0, yt = 0, zt = 0, xh = 0, yh = 0, zh = 0,
       fric = 0, wvel = 0, xhev = 0, yhev = 0, zhev = 0, lenl = 0, lenm = 0, mass = 0, v0 = 0, ro = 0, E = 0,
       pr = 0;
  int soft = 0;
  Vec tail() const { return {xt, yt, zt}; }
};

}  // namespace courant
