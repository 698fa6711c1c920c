#include "sph/walls/wall_law.hpp"

namespace courant {

Real friction_velocity(Real u, Real y, Real nu, Real ks) {
  if (!(u > 0 && y > 0)) return 0;
  constexpr Real smooth = 0.114;              // exp(-0.41 5.3)
  const Real a = smooth * nu, b = ks / 32.6;  // exp(0.41 8.5)
  const Real laminar = std::sqrt(nu * u / y);
  if (a == 0 && b == 0) return 0;
  // Newton's method for s ln(y/(a/s + b)) = 0.41 u from above, where the left side is convex
  Real s = von_karman * u;  // ln = 1
  for (int k = 0; k < 50; ++k) {
    const Real y0 = a / s + b, log = std::log(y / y0);
    if (!(log > 1)) break;
    const Real next = s - (s * log - von_karman * u) / (log + a / (s * y0));
    const bool done = std::abs(next - s) <= 1e-14 * s;
    s = std::max(next, Real(1e-3) * s);
    if (done) break;
  }
  return std::max(laminar, s);
}

}  // namespace courant
