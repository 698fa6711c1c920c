#pragma once
#include <array>

#include "base/real.hpp"

namespace courant {

/// The shape of a rigid wall, relative to its position at t = 0: a plane, or a body that points stay outside
/// of. All are convex: what is before the plane through the nearest position of the surface, at right angles
/// to the normal there, is outside.
struct WallShape {
  enum class Kind { plane, prism, cylinder, sphere };
  Kind kind = Kind::plane;
  /// A point of the plane, a corner of the prism's face, the end of the cylinder's axis, the centre. [L]
  Vec tail = Vec::Zero();
  /// Columns: edges l and m, and n, the normal or the axis of the cylinder, to the right and of length 1.
  Matrix axes = Matrix::Identity();
  /// Along l, m, and -n (prism) or n (cylinder); 0: without an end. [L]
  std::array<Real, 3> length{};
  Real radius = 0;  ///< [L]

  Vec n() const { return axes.col(2); }
  /// A plane that ends beside l or m.
  bool has_edges() const { return kind == Kind::plane && (length[0] > 0 || length[1] > 0); }

  struct Near {
    Real gap = 0;          ///< distance, below 0 inside or behind the plane [L]
    Vec n = Vec::UnitX();  ///< of length 1, out of the wall at the nearest position of its surface
  };
  Near nearest(const Vec& x) const;
  /// Whether a point that goes to `next` meets the wall rather than passing beside it. `gap`: of where it is.
  bool meets(const Vec& next, Real gap) const;

 private:
  Near nearest_of_prism(const Vec& r) const;
  Near nearest_of_cylinder(const Vec& r) const;
};

}  // namespace courant
