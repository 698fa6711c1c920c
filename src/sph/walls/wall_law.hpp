#pragma once
// The velocity near a wall that rubs.
#include <algorithm>
#include <cmath>

#include "base/real.hpp"

namespace courant {

/// How a wall rubs: by a constant coefficient, by the logarithmic law, or by holding water fast.
struct WallFriction {
  Real cf = -1;          ///< shear stress over rho v^2/2 [-]; < 0: the wall does not support
  bool log_law = false;  ///< LAW 1: by distance and velocity
  Real ks = 0;           ///< equivalent roughness of sand [L]
  bool no_slip = false;  ///< LAW 2: water at the wall has its velocity, and viscosity acts
  bool rubs() const { return cf > 0 || log_law; }
};

inline constexpr Real von_karman = 0.41;

/// A particle has its velocity no nearer to a wall than this share of the spacing, half of where the lowest
/// row is at rest: what the velocity is a mean over reaches farther, and a particle that passes an edge
/// crosses the plane of a wall at no distance at all.
inline constexpr Real least_distance = 0.25;

/// Friction velocity u* [L/T] of a wall along which the mean velocity at distance y is u >= 0: from
///   u/u* = ln(y/y0)/0.41,   y0 = 0.114 nu/u* + ks/32.6
/// (Nikuradse's limits: 5.3 + ln(y u*/nu)/0.41 where the wall is smooth, 8.5 + ln(y/ks)/0.41 where it is
/// rough), or u u* y/nu = u^2 of the viscous sublayer where that gives more. A wall whose roughness swallows
/// the distance takes y = e y0. nu: kinematic viscosity [L2/T].
Real friction_velocity(Real u, Real y, Real nu, Real ks);

/// By the law of a wall.
inline Real friction_velocity(const WallFriction& wall, Real u, Real y, Real nu) {
  return wall.log_law ? friction_velocity(u, y, nu, wall.ks) : std::sqrt(std::max(wall.cf, Real(0)) / 2) * u;
}

}  // namespace courant
