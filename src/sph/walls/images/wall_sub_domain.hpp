#pragma once
// Regions whose walls are those of a box corner.
#include "base/real.hpp"

namespace courant {

/// One to three mutually orthogonal walls that form a corner, with no other wall in sight. For a particle
/// in front of all of them, each other particle has one image behind each wall, each pair of walls and all
/// three. Plain data for loops that are compiled per instruction set.
struct WallSubDomain {
  int walls = 0;
  Real n[3][3]{};    ///< into the sub-domain
  Real offset[3]{};  ///< x is n.x - offset in front of the wall [L]
  Index face[3]{};   ///< one face of each wall
  /// A straight edge of a wall: m.x = limit, with m out of the sub-domain.
  struct End {
    Real m[3]{}, limit = 0;
    Real n[3]{}, offset = 0;  ///< of that wall
  };
  static constexpr int most_ends = 4;
  int ends = 0;
  End end[most_ends];
};

/// An isolated edge: the end of a single wall that is exposed on both sides, or a convex corner of two
/// walls that enclose 90 degrees or more. Plain data.
struct WallEdge {
  int walls = 0;
  Real at[3]{};    ///< a position on it [L]
  Real n[2][3]{};  ///< normal of each wall, away from the other wall
  Real m[2][3]{};  ///< from the edge into each wall
  bool moves = false;
  Real v[3]{}, spin[3]{};  ///< of the body that it belongs to, at `at` [L/T], [1/T]
};

/// Reaction of a particle on a moving edge and its walls: its half of each path, where the path meets
/// walls and edge.
struct WallEdgeReaction {
  Real push[2]{};           ///< on each wall, along its n [ML/T2]
  Real inward[2]{};         ///< first moment of `push` about the particle's foot point, along m [ML2/T2]
  Real along[2]{};          ///< the same along the edge [ML2/T2]
  Real edge[2][2]{};        ///< on the edge, along n and m of each wall
  Real edge_along[2][2]{};  ///< first moment of `edge` along the edge, about the particle [ML2/T2]
};

}  // namespace courant
