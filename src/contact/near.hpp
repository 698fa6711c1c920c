#pragma once
#include <algorithm>
#include <span>

#include "contact/contact.hpp"

namespace courant {

/// Depths below this fraction of the contact distance are round-off: a particle pushed out to r is out.
inline constexpr Real depth_tolerance = 1e-9;

/// Shortcuts rely on comparisons with this margin, of the contact distance; round-off is far below.
inline constexpr Real clear_margin = 1e-6;

/// Data of the search for the pushes of one particle.
struct Contact::Near {
  Index particle = 0;
  std::span<const Index> candidate;  ///< facets
  std::span<std::int8_t> side;       ///< of the origin, by candidate
  Vec x = Vec::Zero();               ///< [L]
  Vec origin = Vec::Zero();          ///< last admissible position, most often x itself [L]
};

inline Real Contact::stiffness(Index i, Real kn, Real kf, const Facet& f, const World& world) const {
  Real k = law_.penopt == 2 ? kf : law_.penopt == 3 ? kn : std::min(kn, kf);
  const Real dt = law_.dtstif > 0 ? law_.dtstif : soft_dt_;
  if (law_.soft == 1 && dt > 0)
    k = std::max(k, 0.5 * law_.sofscl * std::min(world.particles.m[i], f.m) / (dt * dt));
  return k;
}

}  // namespace courant
