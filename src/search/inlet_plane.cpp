#include "search/inlet_plane.hpp"

#include <limits>

namespace courant {

Real InletPlane::time_to_reach(const Vec& x, const Vec& v, Real reach) const {
  const Real way = (point - x).dot(normal) - reach, speed = v.dot(normal);
  if (way <= 0) return 0;
  return speed > 0 ? way / speed : std::numeric_limits<Real>::infinity();
}

}  // namespace courant
