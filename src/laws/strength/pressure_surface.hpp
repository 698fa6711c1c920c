#pragma once
// A yield stress q = sqrt(3/2 s:s) over the pressure p, through points of tests.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "base/real.hpp"

namespace courant {

/// Pressure, > 0 in compression, and q there. [M/LT2]
struct PressurePoint {
  Real p, q;
};

/// q over p, below 0 beyond the tips of the surface: by how much p is beyond them, or straight on. [M/LT2]
class PressureSurface {
 public:
  /// q^2 = a + b p + c p^2 through three points of rising pressure.
  static PressureSurface square(PressurePoint x, PressurePoint y, PressurePoint z) {
    PressureSurface out({x, y, z});
    const Real low = (y.q * y.q - x.q * x.q) / (y.p - x.p), high = (z.q * z.q - y.q * y.q) / (z.p - y.p);
    out.c_ = (high - low) / (z.p - x.p), out.b_ = low - out.c_ * (x.p + y.p);
    out.a_ = y.q * y.q - y.p * (out.b_ + out.c_ * y.p), out.is_square_ = true;
    const Real root = std::sqrt(std::max(out.b_ * out.b_ - 4 * out.a_ * out.c_, Real(0)));
    const bool ends = out.b_ * out.b_ >= 4 * out.a_ * out.c_;
    if (ends && out.b_ + root > 0) out.low_ = -2 * out.a_ / (out.b_ + root);
    if (ends && root - out.b_ > 0) out.high_ = 2 * out.a_ / (root - out.b_);
    return out;
  }
  /// Straight between points of rising pressure, and beyond.
  static PressureSurface straight(std::initializer_list<PressurePoint> points) {
    PressureSurface out(points);
    const Real first = out.slope(0), last = out.slope(out.count_ - 2);
    const PressurePoint &begin = out.at_[0], &end = out.at_[out.count_ - 1];
    if (first > 0) out.low_ = begin.p - begin.q / first;
    if (last < 0) out.high_ = end.p - end.q / last;
    return out;
  }

  Real operator()(Real p) const {
    if (is_square_) {
      const Real inside = within(p);
      return inside == p ? std::sqrt(std::max(a_ + p * (b_ + c_ * p), Real(0))) : -std::abs(p - inside);
    }
    std::size_t k = 0;
    while (k + 2 < count_ && p > at_[k + 1].p) ++k;
    return at_[k].q + slope(k) * (p - at_[k].p);
  }
  /// p, or the tip beyond which it lies.
  Real within(Real p) const { return std::min(std::max(p, low_), high_); }
  /// The points are in order, and without pressure there is strength.
  bool rises_in_order() const {
    for (std::size_t k = 0; k + 1 < count_; ++k)
      if (!(at_[k + 1].p > at_[k].p)) return false;
    return (*this)(0) > 0;
  }
  /// q over p nowhere bends upwards.
  bool is_convex() const {
    constexpr Real round_off = 1e-9;
    if (is_square_) return 4 * a_ * c_ <= b_ * b_ + round_off * a_;
    for (std::size_t k = 0; k + 2 < count_; ++k)
      if (slope(k + 1) > slope(k) + round_off) return false;
    return true;
  }

 private:
  PressureSurface(std::initializer_list<PressurePoint> points) : count_(points.size()) {
    std::copy(points.begin(), points.end(), at_.begin());
  }
  Real slope(std::size_t k) const { return (at_[k + 1].q - at_[k].q) / (at_[k + 1].p - at_[k].p); }

  std::array<PressurePoint, 5> at_{};
  std::size_t count_;
  bool is_square_ = false;
  Real a_ = 0, b_ = 0, c_ = 0;  ///< [M2/L2T4], [M/LT2], [-]
  Real low_ = -std::numeric_limits<Real>::infinity(), high_ = std::numeric_limits<Real>::infinity();
};

}  // namespace courant
