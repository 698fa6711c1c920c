#pragma once
// The nearest wall of shells or faces, of any shape, still or moving.
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "sph/boundaries/space_cells.hpp"
#include "sph/walls/wall_surface.hpp"
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
  /// `cell`: of the order of the spacing of particles [L].
  WallDistance(std::vector<Index> segments, Real reach, Real cell, std::vector<GhostPlane> planes,
               const World& world);
  /// Once a step: where walls are now, or where none moves, which faces are next to the positions of
  /// particles. `rebuilds`: of the lists of neighbours; between two of them particles stay near where they
  /// were.
  void follow(const World& world, std::int64_t rebuilds);
  bool any_moves() const { return any_moves_; }
  NearestWall nearest(const Vec& x) const;

 private:
  std::vector<Index> next_to_cell(const Vec& middle) const;
  template <class Faces>
  NearestWall nearest_of(const Faces& faces, const Vec& x) const;

  std::vector<Index> segments_;
  Real reach_;
  SpaceCells cells_;  ///< walls that are held are looked at from few, each time again
  std::vector<GhostPlane> planes_;
  std::unordered_map<std::uint64_t, std::vector<Index>> next_to_;  ///< faces that may be next, by cell
  std::int64_t rebuilds_ = -1;
  bool any_moves_ = false;
  std::optional<WallSurface> surface_;
};

}  // namespace courant
