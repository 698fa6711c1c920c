#pragma once
#include "base/real.hpp"

namespace courant {

/// Where `excess`, > 0 at 0 and <= 0 at `high`, is 0: regula falsi with the weights of the Illinois method,
/// and every third try a bisection.
template <class Excess>
Real root_below(Real high, const Excess& excess) {
  constexpr int rounds = 200;
  constexpr Real close = 1e-15;
  Real low = 0, at_low = excess(low), at_high = excess(high), most = high;
  for (int k = 0; k < rounds && high - low > close * most; ++k) {
    Real x = k % 3 == 2 ? 0.5 * (low + high) : low + (high - low) * at_low / (at_low - at_high);
    if (!(x > low && x < high)) x = 0.5 * (low + high);
    const Real value = excess(x);
    if (value == 0) return x;
    if (value > 0)
      low = x, at_low = value, at_high *= 0.5;
    else
      high = x, at_high = value, at_low *= 0.5;
  }
  return 0.5 * (low + high);
}

}  // namespace courant
