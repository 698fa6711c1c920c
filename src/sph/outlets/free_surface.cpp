#include "sph/outlets/free_surface.hpp"

namespace courant {

Real FreeSurface::filled(const Vec& x, Real t, Real cell, const Vec& normal) const {
  const Real slope = (up - up.dot(normal) * normal).norm();  // 0: the inlet lies flat
  if (!(slope > 1e-6)) return depth(x, t) > 0 ? 1 : 0;
  return std::clamp(depth(x, t) / (slope * cell) + Real(0.5), Real(0), Real(1));
}

std::optional<Vec> upward(const BodyAcceleration& gravity, const Vec& x, Real t, Real endtim, Index part) {
  Vec g = gravity(x, t, part);
  if (g.isZero()) g = gravity(x, endtim, part);
  if (g.isZero()) return std::nullopt;
  return Vec(-g.normalized());
}

}  // namespace courant
