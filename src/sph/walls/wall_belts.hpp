#pragma once
// Moving surfaces: walls that move tangentially while the shells are fixed (lids, rims of drums).
#include <array>
#include <vector>

#include "keyword/card.hpp"
#include "model/model.hpp"
#include "sph/boundaries/boundary_cards.hpp"

namespace courant {

/// Rigid motion of a piece of wall.
struct WallMotion {
  Vec x0 = Vec::Zero(), v = Vec::Zero(), omega = Vec::Zero();  ///< at x0 [L/T]; [1/T]
  /// Velocity at x [L/T].
  Vec at(const Vec& x) const { return v + omega.cross(x - x0); }
};

/// Rigid motion of three points with these positions and velocities, not on one line; in 2D the first two
/// are used. [L], [L/T]
WallMotion rigid_motion(const std::array<Vec, 3>& x, const std::array<Vec, 3>& v, int dim);

/// Moving surface of each segment; without moving surfaces, `of_segment` is empty.
struct WallBelts {
  struct Belt {
    WallMotion motion;  ///< at factor 1
    Real sf = 1;
    Curve curve{};  ///< of the factor over time; without points: 1
    /// Factor of `motion` at time t. [-]
    Real factor(Real t) const { return curve.abscissa.empty() ? sf : sf * curve(t); }
  };
  std::vector<Belt> belts{};
  std::vector<int> of_segment{};  ///< -1: none
  bool any() const { return !belts.empty(); }
  int of(Index segment) const {
    return of_segment.empty() ? -1 : of_segment[static_cast<std::size_t>(segment)];
  }
};

}  // namespace courant
