#pragma once
#include "base/real.hpp"

namespace courant {

/// Neighbour lists are valid until a particle has moved half the skin; of h. See docs/performance.md.
inline constexpr Real least_skin = 0.02, first_skin = 0.1, most_skin = 0.4;
/// See Neighbours::adapt_skin. Where gradients are frozen over steps, entries out of reach are examined only
/// once in a window.
inline constexpr Real skin_weight = 14, skin_weight_of_windows = 28;

}  // namespace courant
