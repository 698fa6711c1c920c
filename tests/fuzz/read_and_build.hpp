#pragma once
#include <string_view>

namespace courant::fuzz {

/// Inputs beyond this size are left out: what is slow or large with less is a fault.
inline constexpr std::size_t largest_input = 64 * 1024;

/// Reads a deck from memory and, if there is no error, builds its model. The input may hold several files,
/// for includes: a line "$$FILE name" begins the next one; the first is the deck. Files of this machine are
/// never read.
void read_and_build(std::string_view input);

}  // namespace courant::fuzz
