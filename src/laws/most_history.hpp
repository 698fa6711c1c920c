#pragma once
#include <cstddef>

namespace courant {

/// Largest number of history values of a law at a point, all components of tensors included.
inline constexpr std::size_t most_history = 28;

}  // namespace courant
