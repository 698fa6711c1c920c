#pragma once
// Functions that are straight between points, and continue beyond them as in the outermost piece, as
// constitutive curves do in LS-DYNA.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/real.hpp"

namespace courant {

/// The piece [x_k, x_k+1) of two or more rising points that holds `at`; beyond them the first or the last.
inline std::size_t piece_of(const std::vector<Real>& x, Real at) {
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  return static_cast<std::size_t>(above - x.begin()) - 1;
}
inline Real slope_of_piece(const std::vector<Real>& x, const std::vector<Real>& y, std::size_t k) {
  return (y[k + 1] - y[k]) / (x[k + 1] - x[k]);
}

/// The function itself; empty: none.
class StraightPieces {
 public:
  StraightPieces() = default;
  /// As many x, rising, as y; two or more.
  StraightPieces(std::vector<Real> x, std::vector<Real> y) : x_(std::move(x)), y_(std::move(y)) {}
  bool empty() const { return x_.empty(); }
  Real last() const { return x_.empty() ? 0 : x_.back(); }  ///< point
  std::size_t pieces() const { return x_.empty() ? 0 : x_.size() - 1; }
  Real slope(std::size_t k) const { return slope_of_piece(x_, y_, k); }
  Real operator()(Real x) const {
    const std::size_t k = piece_of(x_, x);
    return y_[k] + slope(k) * (x - x_[k]);
  }
  /// The largest |slope| of pieces that [from, to] touches.
  Real steepest(Real from, Real to) const {
    Real most = 0;
    for (std::size_t k = piece_of(x_, from), last = piece_of(x_, to); k <= last; ++k)
      most = std::max(most, std::abs(slope(k)));
    return most;
  }

 private:
  std::vector<Real> x_, y_;
};

}  // namespace courant
