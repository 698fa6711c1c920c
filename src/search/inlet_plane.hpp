#pragma once
#include <vector>

#include "base/real.hpp"
#include "state/field.hpp"

namespace courant {

/// The plane of an inlet: particles made for it (particle_waiting) are not solved for before they cross it.
struct InletPlane {
  Vec point = Vec::Zero();    ///< [L]
  Vec normal = Vec::UnitX();  ///< unit vector, downstream
  bool follows = false;       ///< its velocity follows from the run: see InletFlow
  bool behind(const Vec& x) const { return (x - point).dot(normal) >= 0; }
  /// How long until a particle at x upstream of the plane, with constant velocity v, is no further than
  /// `reach` from it; 0 if it is, infinity if it never will be. [T]
  Real time_to_reach(const Vec& x, const Vec& v, Real reach) const;
};

/// The flow of inlets whose velocity is not known beforehand. A particle that waits at one is at `start` +
/// `path` s, with s the displacement of the flow of its inlet since the start.
struct InletFlow {
  const Field<Real>* path = nullptr;   ///< displacement of each waiting particle by that of its inlet [-]
  std::vector<Real> displacement{};    ///< s of each inlet at the present time [L]
  const Field<Real>* start = nullptr;  ///< where each waiting particle is at s = 0 [L]
};

}  // namespace courant
