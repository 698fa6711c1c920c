#pragma once
// Places whose walls are those of a box, as far as anybody there sees.
#include "base/real.hpp"

namespace courant {

/// Walls at right angles to each other that close in a corner, and beside which nothing else stands: one, two
/// or three of them. Who is in front of all of them sees each of the others once by any of the walls, by
/// any two and by all three. Plain numbers, for loops that are compiled for each instruction set.
struct WallRoom {
  int walls = 0;
  Real n[3][3]{};    ///< into the sub-domain
  Real offset[3]{};  ///< x is n.x - offset in front of the wall [L]
  Index face[3]{};   ///< one of each wall's
  /// Where a wall ends: by a straight line along it, m.x = limit, m out of the sub-domain.
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
  Real at[3]{};    ///< a position on it [L]
  Real n[2][3]{};  ///< of each wall, away from the other
  Real m[2][3]{};  ///< from the edge into each wall
  bool moves = false;
  Real v[3]{}, spin[3]{};  ///< of the body that it belongs to, at `at` [L/T], [1/T]
};

/// What a particle beside an edge that moves does to that: its half of each path, as it meets walls and edge.
struct WallEdgePull {
  Real push[2]{};           ///< on each wall, along its n [ML/T2]
  Real inward[2]{};         ///< times how far from the particle's foot that is, along m [ML2/T2]
  Real along[2]{};          ///< and along the edge
  Real edge[2][2]{};        ///< on the edge, along n and m of each wall
  Real edge_along[2][2]{};  ///< times how far along the edge from the particle
};

}  // namespace courant
