#pragma once
#include "base/real.hpp"

namespace courant {

/// How many cells a grid for so many particles has at most.
inline Real most_cells(Index particles) {
  return 16.0 * particles + 4096;
}

}  // namespace courant
