#pragma once
// A function that is straight between points, as StraightPieces, for loops over many arguments: a grid over
// the points says at which piece to start, so that there is nothing to search where points are not far denser
// in some cells than in others.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/straight_pieces.hpp"

namespace courant {

class IndexedPieces {
 public:
  /// What the function does beyond its points.
  enum class Beyond { straight, constant };
  IndexedPieces() = default;
  /// As many x, strictly increasing, as y. Of one point a constant; without points it cannot be evaluated.
  IndexedPieces(const std::vector<Real>& x, const std::vector<Real>& y, Beyond beyond = Beyond::straight) {
    if (x.empty()) return;
    const bool flat = beyond == Beyond::constant || x.size() == 1;
    if (flat) pieces_.push_back({x.front(), y.front(), 0});
    for (std::size_t k = 0; k + 1 < x.size(); ++k) pieces_.push_back({x[k], y[k], slope_of_piece(x, y, k)});
    if (flat) pieces_.push_back({x.back(), y.back(), 0});
    for (std::size_t k = 1; k < pieces_.size(); ++k) begin_.push_back(pieces_[k].x);
    begin_.push_back(std::numeric_limits<Real>::quiet_NaN());
    make_index();
  }
  bool empty() const { return pieces_.empty(); }
  std::size_t size() const { return pieces_.size(); }
  Real slope(std::size_t k) const { return pieces_[k].slope; }
  /// Whether x is beyond piece k; of the last piece nothing is.
  bool ends_before(std::size_t k, Real x) const { return x > begin_[k]; }

  std::size_t piece(Real x) const {
    const Real cell = std::min(last_cell_, std::max(Real(0), (x - from_) * per_cell_));
    std::size_t k = first_[static_cast<std::size_t>(static_cast<std::int32_t>(cell))];
    while (x >= begin_[k]) ++k;
    return k;
  }
  Real of_piece(std::size_t k, Real x) const { return pieces_[k].y + pieces_[k].slope * (x - pieces_[k].x); }
  Real operator()(Real x) const { return of_piece(piece(x), x); }
  Real operator()(Real x, Real& slope_there) const {
    const std::size_t k = piece(x);
    slope_there = pieces_[k].slope;
    return of_piece(k, x);
  }

 private:
  struct Piece {
    Real x, y, slope;
  };
  // Cells are as wide as the closest points, so that each has one at the most, or as many as stay in a cache.
  void make_index() {
    constexpr Real most_cells = 2048;
    first_ = {0};
    if (pieces_.size() < 2) return;
    from_ = begin_.front();
    const Real length = begin_[begin_.size() - 2] - from_;
    Real closest = length;
    for (std::size_t k = 1; k + 1 < begin_.size(); ++k)
      closest = std::min(closest, begin_[k] - begin_[k - 1]);
    const Real cells = length > 0 ? std::min(std::ceil(length / closest) + 1, most_cells) : 1;
    per_cell_ = length > 0 ? (cells - 1) / length : 0, last_cell_ = cells - 1;
    first_.assign(static_cast<std::size_t>(cells), 0);
    // as `piece` has it, so that round-off leaves no point in a cell before its own
    for (std::size_t c = 1, k = 0; c < first_.size(); ++c) {
      while (static_cast<Real>(c) > std::floor((begin_[k] - from_) * per_cell_)) ++k;
      first_[c] = static_cast<std::uint32_t>(k);
    }
  }

  std::vector<Piece> pieces_;
  std::vector<Real> begin_;           ///< of the next piece; of the last one none, NaN
  std::vector<std::uint32_t> first_;  ///< piece in which a cell of the grid begins, or one before
  Real from_ = 0, per_cell_ = 0, last_cell_ = 0;
};

}  // namespace courant
