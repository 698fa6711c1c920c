#pragma once
#include "base/real.hpp"

namespace courant {

/// The computational box (CONTROL_SPH BOXID); without one, every particle is active.
struct Region {
  Vec low, high;
  bool contains(Real x, Real y, Real z) const {
    return x >= low[0] && x <= high[0] && y >= low[1] && y <= high[1] && z >= low[2] && z <= high[2];
  }
  /// How long until a particle at x with constant velocity v is within `reach` of the box in every direction;
  /// 0 if it is, infinity if it never will be. [T]
  Real time_to_reach(const Vec& x, const Vec& v, Real reach) const;
};

}  // namespace courant
