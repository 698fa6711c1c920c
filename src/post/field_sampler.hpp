#pragma once
// Quantities at points of one state.
#include <vector>

#include "post/analysis.hpp"
#include "post/interpolation.hpp"

namespace courant {

/// How an analysis looks at points: keys `of`, `where`, `link`, `share`, `interpolation`, `wet`.
struct FieldSampler {
  std::vector<Quantity> of;
  Where where;
  SprayRule spray;
  Interpolation interpolation = Interpolation::shepard;
  Real wet = 0.5;  ///< a point is in the water where the colour C is at least this

  void read(const MapReader& map, const PostUnits& units);
  void note_needs(std::vector<ParticleArray>& arrays) const;
  struct Sample {
    std::vector<std::vector<Real>> values;  ///< shape: (of, points); NaN outside the water
    std::vector<char> wet;                  ///< shape: (points)
    std::vector<Real> colour;               ///< C of each point, 0 where no particle is near
    std::size_t fallbacks = 0;              ///< points in the water where MLS had to be Shepard
  };
  /// On all threads; a point's value does not depend on their number.
  Sample sample(const PostState& state, const std::vector<Point>& points) const;
};

}  // namespace courant
