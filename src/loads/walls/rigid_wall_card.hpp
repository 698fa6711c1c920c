#pragma once
#include <string>

#include "keyword/deck.hpp"
#include "loads/load_cards.hpp"

namespace courant {

/// What all rigid walls have in common.
struct RigidWallCard : RigidWallFields {
  Vec tail() const { return {xt, yt, zt}; }
  Vec head() const { return {xh, yh, zh}; }
  Vec edge() const { return {xhev, yhev, zhev}; }
};

/// *RIGIDWALL_PLANAR with its options
struct RigidWallPlanar : RigidWallCard {
  /// Options of the name, in the order of `combine` in load_cards.yaml.
  bool finite() const { return name & 1; }
  bool moving() const { return name & 2; }
  bool forces() const { return name & 4; }
  bool display() const { return name & 8; }
};

/// *RIGIDWALL_PLANAR_ORTHO with its options
struct RigidWallOrtho : RigidWallPlanar {};

/// *RIGIDWALL_GEOMETRIC_FLAT, _PRISM, _CYLINDER and _SPHERE with their options
struct RigidWallGeometric : RigidWallCard {
  enum class Shape { flat, prism, cylinder, sphere };
  /// Shape and options of the name, in the order of names and `combine` in load_cards.yaml.
  Shape shape() const { return static_cast<Shape>(name & 3); }
  bool moves() const { return name & 4; }
  bool display() const { return name & 8; }
  bool has_edge() const { return shape() == Shape::flat || shape() == Shape::prism; }
};

}  // namespace courant
