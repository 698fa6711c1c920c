#pragma once
// The nearest wall of shells or faces, of any shape, fixed or moving.
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "sph/boundaries/space_cells.hpp"
#include "sph/walls/wall_surface.hpp"
#include "state/world.hpp"

namespace courant {

/// Nearest wall of a particle.
struct NearestWall {
  Real distance = std::numeric_limits<Real>::infinity();  ///< to the middle of the shell [L]
  Vec normal = Vec::Zero();                               ///< unit vector from the wall to the particle
  Vec velocity = Vec::Zero();                             ///< of the wall there [L/T]
  Index segment = -1;                                     ///< -1: none within reach
};

class WallDistance {
 public:
  /// `reach`: greatest distance [L]; `planes`: of ghosts.
  WallDistance(std::vector<Index> segments, Real reach, Real cell, std::vector<GhostPlane> planes,
               const World& world);
  /// Update once per step: positions of moving walls, or, if all are fixed, the faces near the positions
  /// of particles. `rebuilds`: count of neighbour searches; between two of them particles stay near their
  /// positions.
  void follow(const World& world, std::int64_t rebuilds);
  bool any_moves() const { return any_moves_; }
  NearestWall nearest(const Vec& x) const;

 private:
  std::vector<Index> next_to_cell(const Vec& middle) const;
  template <class Faces>
  NearestWall nearest_of(const Faces& faces, const Vec& x) const;

  std::vector<Index> segments_;
  Real reach_;
  SpaceCells cells_;  ///< of fixed walls
  std::vector<GhostPlane> planes_;
  std::unordered_map<std::uint64_t, std::vector<Index>>
      next_to_;  ///< candidates for the nearest face, by cell
  std::int64_t rebuilds_ = -1;
  bool any_moves_ = false;
  std::optional<WallSurface> surface_;
};

}  // namespace courant
