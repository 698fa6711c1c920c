#pragma once
// The nearest wall of shells or faces, of any shape, still or moving.
#include <memory>
#include <optional>
#include <vector>

#include "sph/boundaries/wall_surface.hpp"
#include "state/world.hpp"

namespace courant {

/// What a particle sees of the nearest wall.
struct NearestWall {
  Real distance = std::numeric_limits<Real>::infinity();  ///< to the middle of the shell [L]
  Vec normal = Vec::Zero();                               ///< unit vector from the wall to the particle
  Vec velocity = Vec::Zero();                             ///< of the wall there [L/T]
  Index segment = -1;                                     ///< -1: there is none within reach
};

class WallDistance {
 public:
  /// `reach`: walls farther off do not count [L]; `planes`: of ghosts.
  WallDistance(std::vector<Index> segments, Real reach, std::vector<GhostPlane> planes, const World& world);
  /// Where walls are now, once a step; `p`: from where anybody looks. Nothing where none moves.
  void follow(const World& world);
  bool any_moves() const { return any_moves_; }
  NearestWall nearest(const Vec& x) const;

 private:
  std::vector<Index> segments_;
  Real reach_;
  std::vector<GhostPlane> planes_;
  bool any_moves_ = false;
  std::optional<WallSurface> surface_;
};

}  // namespace courant
