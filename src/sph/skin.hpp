#pragma once
#include "base/real.hpp"

namespace courant {

/// Neighbour lists hold until something moved half the skin; of h. See docs/performance.md.
inline constexpr Real least_skin = 0.02, first_skin = 0.1, most_skin = 0.4;
/// See Neighbours::adapt_skin. Where gradients are frozen over steps, entries out of reach are looked at once
/// in a window only.
inline constexpr Real skin_weight = 14, skin_weight_of_windows = 28;

}  // namespace courant
