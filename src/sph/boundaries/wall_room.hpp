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

/// An edge beside which nothing else stands: where one wall ends, that is seen from both sides, or where two
/// meet that turn away from each other, at a right angle of what they enclose or a wider one. Plain numbers.
struct WallEdge {
  int walls = 0;
  Real at[3]{};    ///< a place on it [L]
  Real n[2][3]{};  ///< of each wall, away from the other
  Real m[2][3]{};  ///< from the edge into each wall
};

}  // namespace courant
