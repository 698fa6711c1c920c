#pragma once
// Values between particles.
#include <string>
#include <utility>
#include <vector>

#include "post/particle_grid.hpp"

namespace courant {

enum class Interpolation {
  shepard,  ///< sum V W f / sum V W: exact for constant fields
  mls,      ///< moving least squares with a linear base: exact for linear fields
};

/// What particles contribute to the value at a point.
struct PointWeights {
  std::vector<std::pair<std::size_t, Real>>
      of;                 ///< index in ParticleGrid::particles(), weight; sum of weights: 1
  Real colour = 0;        ///< C = sum_j V_j W_j: 1 in water, about 1/2 at its surface and at walls
  bool fallback = false;  ///< MLS was asked for, but the particles lie (nearly) in a line: Shepard
};

/// Weights at a point, with the cubic spline kernel and the particles' own h. No particle in reach: colour 0,
/// no weights. Sources: Shepard (1968); moving least squares: Belytschko, Krongauz, Organ, Fleming and Krysl,
/// Comput. Methods Appl. Mech. Eng. 139 (1996), section 2.2.
PointWeights interpolate(const ParticleGrid& particles, const Point& x, Interpolation kind);

/// Sum of weights times values; shape of values: rows of the frame.
Real weighted(const ParticleGrid& particles, const PointWeights& weights, const std::vector<Real>& values);

}  // namespace courant
