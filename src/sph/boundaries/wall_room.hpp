#pragma once
// Places whose walls are those of a box, as far as anybody there sees.
#include "base/real.hpp"

namespace courant {

/// Walls at right angles to each other that close in a corner, and beside which nothing else stands: one, two
/// or three of them. Who stands in front of all of them sees each of the others once by any of the walls, by
/// any two and by all three. Plain numbers, for loops that are compiled for each instruction set.
struct WallRoom {
  int walls = 0;
  Real n[3][3]{};    ///< into the room
  Real offset[3]{};  ///< x is n.x - offset in front of the wall [L]
  Index face[3]{};   ///< one of each wall's
  /// Where a wall ends: by a straight line along it, m.x = limit, m out of the room.
  struct End {
    Real m[3]{}, limit = 0;
    Real n[3]{}, offset = 0;  ///< of that wall
  };
  static constexpr int most_ends = 4;
  int ends = 0;
  End end[most_ends];
};

}  // namespace courant
