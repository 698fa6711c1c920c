#pragma once
// Several walls at once: where the nearest allowed place of a particle is, and which wall takes which share
// of the push.
#include <array>

#include "base/real.hpp"

namespace courant {

/// What one wall asks of a particle at x: move by at least `depth` along n.
struct Push {
  Index facet = 0;
  Vec n = Vec::Zero();  ///< unit vector away from the wall [-]
  Real depth =
      0;  ///< contact distance minus distance at x; above the contact distance: past the mid-surface [L]
  Real share = 0;       ///< lambda: the part of the push this wall gives [L]
  Vec q = Vec::Zero();  ///< point of the wall that takes the force [L]
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
/// - x with P the projection on the allowed region, so k u is the gradient of k |u|^2 / 2. Walls that say the
/// same thing count once, perpendicular walls act fully, and the stiffness never exceeds k. G_ij is kept
/// above -0.9 so that a gap narrower than the particle stays solvable.
Vec share_pushes(Pushes& pushes);

/// The displacement u that the shares give. [L]
Vec way_out(const Pushes& pushes);

}  // namespace courant
