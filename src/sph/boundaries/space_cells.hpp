#pragma once
// Cubes of space, for what is worked out once for all positions of each.
#include <cmath>
#include <cstdint>

#include "base/real.hpp"

namespace courant {

class SpaceCells {
 public:
  explicit SpaceCells(Real size) : size_(size) {}
  Real size() const { return size_; }
  /// A number that distinguishes all cells within 2^20 of the origin along each axis.
  std::uint64_t of(const Vec& x) const {
    constexpr int bits = 21;  // for each axis
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) {
      const Real cell = std::floor(x[k] / size_);
      constexpr Real most = 9e18;  // what an integer holds
      const std::int64_t place = std::abs(cell) < most ? static_cast<std::int64_t>(cell) : 0;
      key = key << bits | (static_cast<std::uint64_t>(place) & ((std::uint64_t(1) << bits) - 1));
    }
    return key;
  }
  /// Of the cell of x. [L]
  Vec middle(const Vec& x) const { return size_ * ((x / size_).array().floor() + Real(0.5)).matrix(); }

 private:
  Real size_;  ///< [L]
};

}  // namespace courant
