#pragma once
// Law of the wall: velocity near a wall with friction.
#include <algorithm>
#include <cmath>

#include "base/real.hpp"

namespace courant {

/// Friction law of a wall: constant coefficient, logarithmic law, or no slip.
struct WallFriction {
  Real cf = -1;          ///< shear stress over rho v^2/2 [-]; < 0: the wall does not support
  bool log_law = false;  ///< LAW 1: by distance and velocity
  Real ks = 0;           ///< equivalent sand roughness [L]
  bool no_slip = false;  ///< LAW 2: no slip, with viscosity
  bool rubs() const { return cf > 0 || log_law; }
};

inline constexpr Real von_karman = 0.41;

/// Least distance of a particle from a wall over the spacing, half of that of the lowest row at rest: the
/// velocity is a mean over a wider range, and a particle that passes an edge crosses the plane of the wall
/// at zero distance.
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
