#include "loads/walls/wall_friction.hpp"

#include <algorithm>
#include <cmath>

#include "base/run_error.hpp"

namespace courant {

namespace {

using Pair = std::array<Real, 2>;

/// Speed s at the end of the step, which solves sum (u_i/(s + c_i))^2 = 1, u the velocity without friction, c
/// what friction along i takes of it; 0 where nothing slides. The sum is convex and falls: Newton's method
/// from below does not overshoot.
Real speed_left(const Pair& u, const Pair& c) {
  constexpr int most_iterations = 60;
  constexpr Real settled = 1e-15;
  Real s = std::max(Real(0), std::hypot(u[0], u[1]) - std::max(c[0], c[1]));
  for (std::size_t i = 0; i < 2; ++i) s = std::max(s, std::abs(u[i]) - c[i]);
  for (int k = 0; k < most_iterations; ++k) {
    Real sum = 0, slope = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      if (u[i] == 0) continue;
      const Real share = u[i] / (s + c[i]);
      sum += share * share, slope += 2 * share * share / (s + c[i]);
    }
    if (!(sum > 1)) break;  // at the first: friction holds it
    const Real more = (sum - 1) / slope;
    s += more;
    if (more <= settled * s) break;
  }
  return s;
}

}  // namespace

std::array<Real, 2> OrthoFriction::coefficients(Real speed) const {
  Pair mu{};
  for (std::size_t i = 0; i < 2; ++i)
    mu[i] = sliding[i] + (at_rest[i] - sliding[i]) * std::exp(-decay[i] * speed);
  return mu;
}

Vec OrthoFriction::force(const Vec& n, const Vec& slip, Real normal, Real m, Real dt, bool confined) const {
  const Vec along = d - d.dot(n) * n;
  constexpr Real least_sine = 1e-6;
  if (!(along.norm() > least_sine * d.norm()))
    throw RunError(
        "the direction of friction between NODE1 and NODE2 of a *RIGIDWALL_PLANAR_ORTHO is normal "
        "to the wall",
        "name two nodes whose line stays along the wall, or give the direction by D1, D2, D3, which stays");
  const Vec a = along.normalized(), b = n.cross(a);
  const Pair u{slip.dot(a), slip.dot(b)}, mu = coefficients(slip.norm());
  const Real speed = std::hypot(u[0], u[1]);
  if (!(speed > 0)) return Vec::Zero();
  if (confined) {
    const Real share = (mu[0] * u[0] * u[0] + mu[1] * u[1] * u[1]) / (speed * speed);
    return -std::min(share * normal, m * speed / dt) / speed * slip;
  }
  const Pair c{mu[0] * normal * dt / m, mu[1] * normal * dt / m};
  const Real s = speed_left(u, c);
  Pair force{};
  for (std::size_t i = 0; i < 2; ++i)
    if (u[i] != 0) force[i] = -m / dt * u[i] * c[i] / (s + c[i]);
  return force[0] * a + force[1] * b;
}

}  // namespace courant
