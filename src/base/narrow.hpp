#pragma once
// Numbers of 16 bits, for what loops over pairs keep between steps: they wait for memory, not for arithmetic.
#include <cstdint>

namespace courant {

/// A number of known range, in units of a 32767th of its largest value.
using Short = std::int16_t;
inline constexpr double largest_short = 32767;
/// The upper half of a number of single precision: any range, rounded by at most 2^-9 of itself (0.2 %).
enum class Brief : std::uint16_t {};

}  // namespace courant
