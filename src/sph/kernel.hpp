#pragma once
#include <algorithm>

#include "base/real.hpp"

namespace courant {

/// Cubic B-spline, W(r, h) = theta(r/h) / h^Dim with support 2h.
///   theta(R) = C (1 - 3/2 R^2 + 3/4 R^3) for R < 1,  C/4 (2 - R)^3 for 1 <= R < 2.
/// Source: Jonsson et al. 2016, eqs 8-10, with C = 2/3, 10/(7 pi), 1/pi. The constants printed there (3/2,
/// 45/(14 pi), 9/(4 pi)) make the kernel integrate to 2.25. Written without branches, so that pair loops
/// vectorise.
template <int Dim>
struct CubicSpline {
  static constexpr Real C = Dim == 1 ? 2.0 / 3.0 : Dim == 2 ? 10.0 / (7.0 * pi) : 1.0 / pi;
  static constexpr Real support = 2;

  /// theta(R), without C
  static Real shape(Real R) {
    const Real a = std::max(2 - R, Real(0)), b = std::max(1 - R, Real(0));
    return 0.25 * a * a * a - b * b * b;
  }
  /// d theta / dR, without C
  static Real slope(Real R) {
    const Real a = std::max(2 - R, Real(0)), b = std::max(1 - R, Real(0));
    return 3 * b * b - 0.75 * a * a;
  }
};

/// Added to r^2 relative to h^2, so that two particles in one place give zero force instead of 0/0.
inline constexpr Real tiny_distance2 = 1e-24;

/// h^n for the small powers kernels need.
template <int n>
[[gnu::always_inline]] inline Real power(Real h) {
  if constexpr (n == 0) return 1;
  return h * power<n - 1>(h);
}
template <>
[[gnu::always_inline]] inline Real power<0>(Real) {
  return 1;
}

}  // namespace courant
