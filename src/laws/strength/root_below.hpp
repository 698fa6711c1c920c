#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/real.hpp"

namespace courant {

/// Where `excess`, > 0 at 0 and <= 0 at `high`, is 0 below `high`: inverse quadratic interpolation where it
/// is safe, bisection elsewhere (Chandrupatla 1997), from a secant on.
template <class Excess>
Real root_below(Real high, const Excess& excess) {
  constexpr int rounds = 200;
  constexpr Real close = 0.5e-15, eps = std::numeric_limits<Real>::epsilon();
  // x: the newest point; y: the nearest one on the other side of the root; z: the one before
  Real x = 0, y = high, at_x = excess(x), at_y = excess(y);
  if (!(high > 0) || !(at_x > 0)) return 0;
  if (at_y > 0) return high;
  Real t = at_x / (at_x - at_y);
  if (!(t < 1)) t = 0.5;  // a root at `high` itself is none, nor is a secant of infinities
  for (int k = 0; k < rounds; ++k) {
    const Real now = x + t * (y - x), at_now = excess(now);
    Real z = x, at_z = at_x;
    if ((at_now > 0) != (at_x > 0)) z = y, at_z = at_y, y = x, at_y = at_x;
    x = now, at_x = at_now;
    const Real best = std::abs(at_x) < std::abs(at_y) ? x : y;
    const Real least = (2 * eps * std::abs(best) + close * high) / std::abs(y - x);
    if (at_x == 0 || !(least <= 0.5)) return best;
    const Real xi = (x - y) / (z - y), phi = (at_x - at_y) / (at_z - at_y);
    const bool safe = phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi;
    t = safe ? at_x / (at_y - at_x) * at_z / (at_y - at_z) +
                   (z - x) / (y - x) * at_x / (at_z - at_x) * at_y / (at_z - at_y)
             : 0.5;
    t = std::clamp(t, least, 1 - least);
  }
  return std::abs(at_x) < std::abs(at_y) ? x : y;
}

}  // namespace courant
