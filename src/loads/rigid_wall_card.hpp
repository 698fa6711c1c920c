#pragma once
#include <string>

#include "keyword/deck.hpp"

namespace courant {

/// What all rigid walls have in common.
struct RigidWallCard : Entry {
  std::string title;
  Id id = 0, nsid = 0, nsidex = 0, boxid = 0, pid = 0;
  Real offset = 0, birth = 0, death = 1e20, xt = 0, yt = 0, zt = 0, xh = 0, yh = 0, zh = 0, fric = 0,
       xhev = 0, yhev = 0, zhev = 0, lenl = 0, lenm = 0, ro = 0, E = 0, pr = 0;
  Vec tail() const { return {xt, yt, zt}; }
  Vec head() const { return {xh, yh, zh}; }
  Vec edge() const { return {xhev, yhev, zhev}; }
};

/// *RIGIDWALL_PLANAR with its options
struct RigidWallPlanar : RigidWallCard {
  /// The name tells which cards there are; see planar_names.
  bool finite() const { return name & 1; }
  bool moving() const { return name & 2; }
  bool forces() const { return name & 4; }
  bool display() const { return name & 8; }
  Id ssid = 0, n1 = 0, n2 = 0, n3 = 0, n4 = 0;
  Real rwksf = 1, wvel = 0, mass = 0, v0 = 0;
  int soft = 0;
};

/// *RIGIDWALL_PLANAR_ORTHO with its options
struct RigidWallOrtho : RigidWallPlanar {
  Id node1 = 0, node2 = 0;
  Real sfrica = 0, sfricb = 0, dfrica = 0, dfricb = 0, decaya = 0, decayb = 0, d1 = 0, d2 = 0, d3 = 0;
};

/// *RIGIDWALL_GEOMETRIC_FLAT, _PRISM, _CYLINDER and _SPHERE with their options
struct RigidWallGeometric : RigidWallCard {
  enum class Shape { flat, prism, cylinder, sphere };
  /// The name tells the shape and which cards there are; see geometric_names.
  Shape shape() const { return static_cast<Shape>(name & 3); }
  bool moves() const { return name & 4; }
  bool display() const { return name & 8; }
  bool has_edge() const { return shape() == Shape::flat || shape() == Shape::prism; }
  Id lcid = 0;
  int nsegs = 0, opt = 0;
  Real lenp = 0, radcyl = 0, lencyl = 0, radsph = 0, vl = 0, height = 0, vx = 0, vy = 0, vz = 0;
};

}  // namespace courant
