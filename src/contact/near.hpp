#pragma once
#include <span>

#include "contact/contact.hpp"

namespace courant {

/// Depths below this fraction of the contact distance are round-off: a particle pushed out to r is out.
inline constexpr Real depth_tolerance = 1e-9;

/// Shortcuts rely on comparisons with this margin, of the contact distance; round-off is far below.
inline constexpr Real clear_margin = 1e-6;

/// What the search for one particle's pushes works with.
struct Contact::Near {
  Index particle = 0;
  std::span<const Index> candidate;  ///< facets
  std::span<std::int8_t> side;       ///< of the origin, by candidate
  Vec x = Vec::Zero();               ///< [L]
  Vec origin = Vec::Zero();          ///< a place in front of all walls: x itself, or the ghost [L]
};

}  // namespace courant
