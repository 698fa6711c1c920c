#pragma once
// Visibility of fixed walls, by cells of space.
#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

#include "sph/boundaries/space_cells.hpp"
#include "sph/walls/images/wall_paths.hpp"
#include "sph/walls/images/wall_sub_domain.hpp"

namespace courant {

/// Walls that are visible from a cell.
struct CellVisibility {
  bool nothing = true;
  bool alike = true;  ///< the faces of each sheet have the same law
  WallPaths::Sheets sheets;
  std::vector<OpenSubDomain> domains;  ///< that positions in the cell may belong to
  std::vector<Index> points;           ///< of the surface in reach, if sub-domains do not cover the cell
  /// The sub-domain of x, without edges within `sight` [L]; null: none.
  const WallSubDomain* sub_domain_of(const Vec& x, Real sight) const;
};

/// Fixed walls have the same visibility at any time, so each cell is evaluated once. The result for a
/// particle holds until the next neighbour search.
class WallVisibility {
 public:
  /// Whether two faces have the same law.
  using Alike = std::function<bool(Index face, Index other)>;
  /// `width`: of edge transitions; `cell`: size of cells; `reach`: range of visibility plus the travel
  /// until the next search [L]. The surface must reach farther by twice `half_of` a cell and half of the
  /// width.
  WallVisibility(const WallSurface& surface, Real width, Real cell, Real reach, Alike alike);
  static Real half_of(Real cell, int dim);
  /// Updates the cell of each active particle.
  void look_from(const Particles& p);
  const CellVisibility& of(Index i) const { return *seen_[static_cast<std::size_t>(i)]; }
  /// The sub-domain of particle i at x with the range `sight` until the next search; null: none. `own`
  /// holds the result if it is not valid for the whole cell.
  const WallSubDomain* sub_domain(Index i, const Vec& x, Real sight,
                                  std::unique_ptr<WallSubDomain>& own) const;
  /// The same; its walls may end within sight, but not within half of the width.
  const WallSubDomain* open_sub_domain(Index i, const Vec& x, Real sight,
                                       std::unique_ptr<WallSubDomain>& own) const;
  const WallPaths& paths() const { return paths_; }

 private:
  CellVisibility visibility_from(const Vec& middle) const;

  const WallSurface& surface_;
  WallPaths paths_;
  Real reach_, width_;
  SpaceCells cells_;
  Alike alike_;
  std::unordered_map<std::uint64_t, CellVisibility> visibility_;
  std::vector<const CellVisibility*> seen_;
};

}  // namespace courant
