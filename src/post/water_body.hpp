#pragma once
// The connected body of water, without drops and spray.
#include "post/particle_grid.hpp"

namespace courant {

/// What counts as spray.
struct SprayRule {
  Real link =
      1.5;  ///< two particles belong together where they are closer than link times their mean h; up to 2
  Real share = 0.02;  ///< a group with less than this share of the volume is spray, unless it is the largest
};

/// The particles that are no spray. The rule is about groups of particles that hang together, so a drop
/// belongs to the water again once it touches it.
ParticleGrid water_body(const ParticleGrid& all, const SprayRule& rule);

/// A piece of water on a line along an axis. [L]
struct WaterInterval {
  Real low = 0, high = 0;
};

/// All pieces of water on the line through x along `axis`, from low to high: where the colour C = sum_j V_j W
/// is at least 1/2. Ends are found on steps of h/16, linear in between. Pieces thinner than half an h are
/// none.
std::vector<WaterInterval> water_on_line(const ParticleGrid& water, const Point& x, std::size_t axis,
                                         Real* filled = nullptr);

}  // namespace courant
