#pragma once
// What particles see of walls that are held, by cells of space.
#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

#include "sph/boundaries/space_cells.hpp"
#include "sph/walls/images/wall_paths.hpp"
#include "sph/walls/images/wall_room.hpp"

namespace courant {

/// From anywhere in a cell.
struct WallOutlook {
  bool nothing = true;
  bool alike = true;  ///< the faces of each sheet are
  WallPaths::Sheets sheets;
  std::vector<OpenRoom> rooms;  ///< of which positions in the cell may be in one
  std::vector<Index> points;    ///< of the surface, that may matter where rooms do not do
  /// The sub-domain that x is in, who sees edges that far; null: none.
  const WallRoom* room_of(const Vec& x, Real sight) const;
};

/// Walls that are held look the same from a position at any time, so each cell is looked
/// from once. What is in sight of a particle when neighbours are searched stays so until the next search.
class WallOutlooks {
 public:
  /// Walls of a sub-domain are of faces that are `alike`.
  using Alike = std::function<bool(Index face, Index other)>;
  /// `width`: of edges; `cell`: size of cells; `reach`: how far anybody looks, and goes until the next search
  /// [L]. The surface must look twice `half_of` a cell and half of the width farther.
  WallOutlooks(const WallSurface& surface, Real width, Real cell, Real reach, Alike alike);
  static Real half_of(Real cell, int dim);
  /// From where active particles are now.
  void look_from(const Particles& p);
  const WallOutlook& of(Index i) const { return *seen_[static_cast<std::size_t>(i)]; }
  /// The sub-domain of a particle that is at x and sees walls as far as `sight` until the next search; null:
  /// none. `own`: where it is kept if its cell has none for all of its positions.
  const WallRoom* room(Index i, const Vec& x, Real sight, std::unique_ptr<WallRoom>& own) const;
  /// The same, of one whose walls may end within sight, but not within half of the width.
  const WallRoom* open_room(Index i, const Vec& x, Real sight, std::unique_ptr<WallRoom>& own) const;
  const WallPaths& paths() const { return paths_; }

 private:
  WallOutlook outlook_from(const Vec& middle) const;

  const WallSurface& surface_;
  WallPaths paths_;
  Real reach_, width_;
  SpaceCells cells_;
  Alike alike_;
  std::unordered_map<std::uint64_t, WallOutlook> outlooks_;
  std::vector<const WallOutlook*> seen_;
};

}  // namespace courant
