#pragma once
// Logarithm and exponential function for files that are compiled once for each instruction set: plain
// arithmetic without branches and calls, so that loops over them go through registers of several numbers. The
// error is below 1e-15 of the value.
#include <bit>
#include <cstdint>

#include "base/simd.hpp"

namespace courant::COURANT_SIMD {

/// ln x of a normal x > 0, NaN of NaN, by x = 2^n z, 0.7 < z < 1.5, and 2 artanh((z - 1)/(z + 1)) as a series
/// (Abramowitz & Stegun 1964, 4.1.27).
COURANT_INLINE Real natural_logarithm(Real x) {
  constexpr std::uint64_t root_half = 0x3fe6a09e667f3bcd, mantissa = 0x000fffffffffffff;
  constexpr std::uint64_t two_52 = 0x4330000000000000;
  constexpr Real two_52_and_bias = 4503599627370496.0 + 1022;
  constexpr Real ln2_high = 0x1.62e42fefa38p-1, ln2_low = 0x1.ef35793c7673p-45;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  // counted from sqrt(1/2), so that z is around 1
  const std::uint64_t above = bits - root_half, exponent = (above >> 52) + 1022;
  const Real z = std::bit_cast<Real>((above & mantissa) + root_half);
  const Real n = std::bit_cast<Real>(two_52 | (exponent & 0xfff)) - two_52_and_bias;
  const Real s = (z - 1) / (z + 1), t = s * s;
  Real series = 2.0 / 23;
  series = series * t + 2.0 / 21;
  series = series * t + 2.0 / 19;
  series = series * t + 2.0 / 17;
  series = series * t + 2.0 / 15;
  series = series * t + 2.0 / 13;
  series = series * t + 2.0 / 11;
  series = series * t + 2.0 / 9;
  series = series * t + 2.0 / 7;
  series = series * t + 2.0 / 5;
  series = series * t + 2.0 / 3;
  const Real none = x - x;  // NaN of NaN
  return n * ln2_high + (2 * s + (s * t * series + n * ln2_low)) + none;
}

/// e^x; beyond +-708 as there; NaN of NaN. By x = n ln 2 + r, |r| < 0.35, and the series of e^r.
COURANT_INLINE Real exponential(Real x) {
  constexpr Real most = 708, per_ln2 = 1.4426950408889634, shift = 6755399441055744.0;  // 1.5 2^52: rounds
  constexpr Real ln2_high = 0x1.62e42fefa38p-1, ln2_low = 0x1.ef35793c7673p-45;
  const Real low = x > most ? most : x, held = low < -most ? -most : low;
  const Real shifted = held * per_ln2 + shift, n = shifted - shift;
  const Real r = held - n * ln2_high - n * ln2_low;
  Real series = 1.0 / 6227020800;
  series = series * r + 1.0 / 479001600;
  series = series * r + 1.0 / 39916800;
  series = series * r + 1.0 / 3628800;
  series = series * r + 1.0 / 362880;
  series = series * r + 1.0 / 40320;
  series = series * r + 1.0 / 5040;
  series = series * r + 1.0 / 720;
  series = series * r + 1.0 / 120;
  series = series * r + 1.0 / 24;
  series = series * r + 1.0 / 6;
  series = series * r + 1.0 / 2;
  const Real value = 1 + (r + r * r * series);
  const std::uint64_t power = std::bit_cast<std::uint64_t>(shifted) + 1023;  // its last bits are n
  return value * std::bit_cast<Real>(power << 52);
}

/// x^p; 0 for x that is no normal number > 0, NaN of NaN.
COURANT_INLINE Real to_power(Real x, Real p) {
  constexpr Real least = 2.2250738585072014e-308;
  const bool counts = x >= least;
  const Real out = exponential(p * natural_logarithm(counts ? x : 1));
  return counts ? out : x - x;
}

}  // namespace courant::COURANT_SIMD
