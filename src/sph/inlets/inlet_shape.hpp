#pragma once
// Where the particles of a layer are in the plane of an inlet.
#include <optional>
#include <vector>

#include "base/real.hpp"

namespace courant {

/// Positions in the plane of an inlet, and what part of its area each has.
struct InletShape {
  std::vector<Vec> places;  ///< [L]
  Real area = 0;            ///< of one position [L2], in 2D per unit of depth [L]
  Real spacing = 0;         ///< between neighbours in the plane [L]
};

/// Side of the square lattice on whose corners all points stand, in 2D the distance along their line; points
/// need not fill a rectangle. `normal`: of their plane. Nothing for one point, or where they stand otherwise.
/// [L]
std::optional<Real> lattice_side(const std::vector<Vec>& points, const Vec& normal, int dim);

/// A rectangle, in 2D a line along e1, cut into equal cells as near as can be to squares of side `size`, a
/// particle in the middle of each. e1, e2: unit vectors.
InletShape rectangle(const Vec& centre, const Vec& e1, const Vec& e2, Real length1, Real length2, Real size,
                     int dim);

/// The cells of a square lattice around the centre that lie within the circle, stretched a little so that
/// together they have its area; in 2D a line of 2 radius along e1.
InletShape circle(const Vec& centre, const Vec& e1, const Vec& e2, Real radius, Real size, int dim);

}  // namespace courant
