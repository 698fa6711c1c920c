#pragma once
// Surfaces of walls that move along themselves while their shells stand: moving surfaces, lids, rims of
// drums.
#include <array>
#include <vector>

#include "keyword/card.hpp"
#include "model/model.hpp"
#include "sph/boundaries/boundary_cards.hpp"

namespace courant {

/// How a rigid piece of wall moves.
struct WallMotion {
  Vec x0 = Vec::Zero(), v = Vec::Zero(), omega = Vec::Zero();  ///< at x0 [L/T]; [1/T]
  /// Velocity of what moves with it at x [L/T].
  Vec at(const Vec& x) const { return v + omega.cross(x - x0); }
};

/// How a rigid body moves three points of which have these positions and velocities; in 2D the first two
/// count. They are not on one line. [L], [L/T]
WallMotion rigid_motion(const std::array<Vec, 3>& x, const std::array<Vec, 3>& v, int dim);

/// Of each segment the moving surface that it belongs to; where there is none, `of_segment` is empty.
struct WallBelts {
  struct Belt {
    WallMotion motion;  ///< at factor 1
    Real sf = 1;
    Curve curve{};  ///< of the factor over time; without points: 1
    /// By which `motion` is multiplied at time t. [-]
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
