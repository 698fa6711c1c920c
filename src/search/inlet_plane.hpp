#pragma once
#include "base/real.hpp"

namespace courant {

/// The plane of an inlet: particles made for it (particle_waiting) are not solved for before they cross it.
struct InletPlane {
  Vec point = Vec::Zero();    ///< [L]
  Vec normal = Vec::UnitX();  ///< unit vector, downstream
  bool behind(const Vec& x) const { return (x - point).dot(normal) >= 0; }
  /// How long until a particle at x upstream of the plane, with constant velocity v, is no further than
  /// `reach` from it; 0 if it is, infinity if it never will be. [T]
  Real time_to_reach(const Vec& x, const Vec& v, Real reach) const;
};

}  // namespace courant
