#pragma once
// Cells for sorting and searching particles. A row of cells runs along x; rows are visited like a snake, so
// that particles which follow each other in the sorted order are near each other, also where rows meet. The
// borders of cells are multiples of their size from an origin that does not change in a run, and rows turn at
// even numbers of these: the order of two particles depends on where they are, not on what the grid covers.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/real.hpp"
#include "search/near_loops.hpp"
#include "state/saved_state.hpp"

namespace courant {

class CellGrid {
 public:
  /// `row`: width of a row in y and z, `bin`: length of a cell along x [L]; both grow where low..high [L]
  /// would have more than `most` cells.
  void set_size(const Vec& low, const Vec& high, Real row, Real bin, Real most);
  /// Covers low..high [L].
  void cover(const Vec& low, const Vec& high);
  /// Where borders of cells meet, whatever their size is. [L]
  void set_origin(const Vec& origin) { origin_ = origin; }

  Index total() const { return cells_[0] * cells_[1] * cells_[2]; }
  /// For the loop that finds the cells of particles.
  CellFrame frame() const;

  void keep(Archive& archive);

  /// Calls `visit(first, last)` with ranges of cells, last included, that together hold every point within
  /// `reach` of the box low..high.
  template <class Visit>
  void near(const Vec& low, const Vec& high, Real reach, const Visit& visit) const;

 private:
  Index at(Real x, int axis) const {
    const Real k = std::floor((x - origin_[axis]) * inverse_[axis]) - first_[axis];
    return k > 0 ? (k < cells_[axis] - 1 ? static_cast<Index>(k) : cells_[axis] - 1) : 0;
  }
  Index row_at(Index y, Index z) const { return z * cells_[1] + (z & 1 ? cells_[1] - 1 - y : y); }
  Index place(Index x, Index row) const { return row * cells_[0] + (row & 1 ? cells_[0] - 1 - x : x); }
  /// Distance along an axis between low..high and layer k of cells; 0 where the layer at the border also
  /// holds what lies beyond it.
  Real gap(Real low, Real high, Index k, Real size, int axis) const {
    const Real start = origin_[axis] + (first_[axis] + static_cast<Real>(k)) * size;
    return std::max({start - high, low - start - size, Real(0)});
  }

  Vec origin_ = Vec::Zero();
  Vec first_ = Vec::Zero();  ///< even numbers of cells from the origin to the first one, along each axis
  Vec inverse_ = Vec::Ones();
  std::array<Index, 3> cells_{1, 1, 1};
};

template <class Visit>
void CellGrid::near(const Vec& low, const Vec& high, Real reach, const Visit& visit) const {
  const Real width = 1 / inverse_[1];  // of a row, the same in y and z
  const Index z0 = at(low[2] - reach, 2), z1 = at(high[2] + reach, 2);
  const Index y0 = at(low[1] - reach, 1), y1 = at(high[1] + reach, 1);
  for (Index z = z0; z <= z1; ++z) {
    const Real gz = gap(low[2], high[2], z, width, 2);
    for (Index y = y0; y <= y1; ++y) {
      const Real gy = gap(low[1], high[1], y, width, 1);
      const Real left = reach * reach - gy * gy - gz * gz;
      if (left < 0) continue;
      const Real w = std::sqrt(left);
      const Index row = row_at(y, z);
      const Index a = place(at(low[0] - w, 0), row), b = place(at(high[0] + w, 0), row);
      visit(std::min(a, b), std::max(a, b));
    }
  }
}

}  // namespace courant
