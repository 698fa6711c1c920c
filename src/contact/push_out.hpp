#pragma once
// Several walls at once: the nearest allowed position of a particle, and the share of each wall in the push.
#include <array>

#include "base/real.hpp"

namespace courant {

/// Condition of one wall on a particle at x: a displacement of at least `depth` along n.
struct Push {
  Index facet = 0;
  Vec n = Vec::Zero();  ///< unit vector away from the wall [-]
  Real depth =
      0;  ///< contact distance minus distance at x; above the contact distance: past the mid-surface [L]
  Real share = 0;       ///< lambda: the part of the push by this wall [L]
  Vec q = Vec::Zero();  ///< point of the wall that gets the force [L]
  bool face = false;    ///< q is inside the facet, not on its edges
};

/// Pushes of one particle, at most `capacity`: three walls of a box corner and a few neighbours in curved
/// meshes.
struct Pushes {
  static constexpr int capacity = 6;
  std::array<Push, capacity> at;
  int count = 0;
  bool has(Index facet) const {
    for (int i = 0; i < count; ++i)
      if (at[i].facet == facet) return true;
    return false;
  }
};

/// Finds shares lambda >= 0 with sum_j G_ij lambda_j >= depth_i (equal where lambda_i > 0), G_ij = n_i.n_j,
/// and returns the displacement u = sum lambda_i n_i [L]. That is the shortest path out of all walls: u =
/// P(x)
/// - x with P the projection on the allowed region, so k u is the gradient of k |u|^2 / 2. Walls with the
/// same condition count once, perpendicular walls act fully, and the stiffness never exceeds k. G_ij is kept
/// above -0.9 so that a gap narrower than the particle remains solvable.
Vec share_pushes(Pushes& pushes);

/// The displacement u of the shares. [L]
Vec way_out(const Pushes& pushes);

}  // namespace courant
