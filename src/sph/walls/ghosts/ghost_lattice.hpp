#pragma once
// Where fixed ghost particles are behind the shells that hold water.
#include <vector>

#include "search/ghosts.hpp"

namespace courant {

/// A ghost where the scene starts.
struct WallGhost {
  Vec x = Vec::Zero();
  Index segment = 0;  ///< the shell behind which it is
};

/// How ghosts are laid.
struct GhostLattice {
  int dim = 3;
  Vec origin = Vec::Zero();  ///< a particle of the water; ghosts continue its lattice [L]
  Real spacing = 0;          ///< [L]
  Real reach = 0;            ///< of the kernel: ghosts farther behind a wall than this act on nothing [L]
  Vec up = Vec::Zero();      ///< against gravity, of length 1; 0 without gravity
  std::vector<GhostPlane> planes{};  ///< of symmetry or period: the scene ends there
};

struct LaidGhosts {
  std::vector<WallGhost> ghosts;
  std::vector<Index> wet_on_both_sides;  ///< shells that have no dry side where ghosts could are
  std::vector<Index> dry;                ///< shells that no water can reach
  std::vector<Index> thin;               ///< shells behind which water begins again within the reach
  std::vector<Index> open;               ///< shells that move, of parts that are not closed: gates, pistons
  bool too_large = false;                ///< the lattice would have more points than memory allows
};

/// Ghosts behind the shells `segments`, all of which are rigid. `moves`, by segment: whether its part can
/// move.
///
/// Water reaches from its particles to any point of the lattice within the box around shells and water that
/// it can get to without crossing a shell. Above the highest particle it never goes down, so that it does not
/// climb over the rim of a tank. What it does not reach is dry. A ghost is a dry point within `reach` of a
/// shell whose other side is wet: right behind it, or behind all shells that meet at the nearest point; or a
/// point less than half a spacing before a shell where no particle is, as water keeps half a spacing off.
/// Shells go on behind planes as their copies do, without ghosts: these are copied, too.
/// For shells that are held, parts that move and are not closed (gates, pistons) are no obstacle to the
/// water: it will be where they are.
LaidGhosts lay_wall_ghosts(const World& world, const std::vector<Index>& segments,
                           const std::vector<char>& moves, const GhostLattice& lattice);

}  // namespace courant
