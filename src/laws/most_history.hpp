#pragma once
#include <cstddef>

namespace courant {

/// Numbers of the histories of a law at a point that elements and particles have room for.
inline constexpr std::size_t most_history = 24;

}  // namespace courant
