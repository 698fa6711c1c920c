#pragma once
// Positions of fixed ghost particles behind the shells that contain water.
#include <vector>

#include "search/ghosts.hpp"

namespace courant {

/// A ghost at its initial position.
struct WallGhost {
  Vec x = Vec::Zero();
  Index segment = 0;  ///< the shell behind which it is
};

/// Settings of the ghost lattice.
struct GhostLattice {
  int dim = 3;
  Vec origin = Vec::Zero();          ///< a particle of the water; ghosts continue its lattice [L]
  Real spacing = 0;                  ///< [L]
  Real reach = 0;                    ///< of the kernel: ghosts deeper behind a wall have no effect [L]
  Vec up = Vec::Zero();              ///< against gravity, of length 1; 0 without gravity
  std::vector<GhostPlane> planes{};  ///< of symmetry or period: the scene ends there
};

struct LaidGhosts {
  std::vector<WallGhost> ghosts;
  std::vector<Index> wet_on_both_sides;  ///< shells without a dry side for ghosts
  std::vector<Index> dry;                ///< shells that no water can reach
  std::vector<Index> thin;               ///< shells behind which water begins again within the reach
  std::vector<Index> open;               ///< shells that move, of parts that are not closed: gates, pistons
  bool too_large = false;                ///< the lattice would have more points than memory allows
};

/// Ghosts behind the shells `segments`, all of them rigid. `moves`, by segment: whether its part can move.
///
/// The wet region is the set of lattice points within the box around shells and water that can be reached
/// from water particles without crossing a shell. Above the highest particle the search never descends, so
/// it does not climb over the rim of a tank. All other points are dry. A ghost is a dry point within
/// `reach` of a shell whose other side is wet: directly behind the shell, or behind all shells that meet
/// at the nearest point; or a point less than half a spacing in front of a shell without a particle, as
/// water keeps half a spacing away. Shells continue behind planes as copies, without ghosts of their own:
/// those are copied, too. For fixed shells, moving parts that are not closed (gates, pistons) are no
/// obstacle to the water, which will move there.
LaidGhosts lay_wall_ghosts(const World& world, const std::vector<Index>& segments,
                           const std::vector<char>& moves, const GhostLattice& lattice);

}  // namespace courant
