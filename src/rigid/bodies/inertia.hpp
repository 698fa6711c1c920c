#pragma once
// Mass, centre, inertia and momentum of bodies of constant density, integrated over their elements.
#include <array>

#include "base/real.hpp"

namespace courant {

/// Integrals over a body of mass elements dm at positions x with velocities v. Places count from `origin`,
/// which should be near the body.
struct MassIntegrals {
  Vec origin = Vec::Zero();
  Real m = 0;                      ///< of dm [M]
  Vec x = Vec::Zero();             ///< of x dm [ML]
  Matrix xx = Matrix::Zero();      ///< of x x^T dm [ML2]
  Vec momentum = Vec::Zero();      ///< of v dm [ML/T]
  Vec about_origin = Vec::Zero();  ///< of x cross v dm [ML2/T]

  void add_point(Real mass, const Vec& place, const Vec& velocity);
  MassIntegrals& operator*=(Real factor);
  MassIntegrals& operator+=(const MassIntegrals& other);  ///< of the same origin

  Vec centre() const { return origin + x / m; }
  /// About the centre: trace(S) 1 - S, S the second moments there. [ML2]
  Matrix inertia() const;
  /// About the centre [ML2/T]
  Vec angular_momentum() const { return about_origin - (x / m).cross(momentum); }
};

using Quadrilateral = std::array<Vec, 4>;  ///< corners in order; a triangle repeats its third

/// Adds a shell of unit mass per area and thickness t about its mid-surface, which is interpolated
/// bilinearly between the corners, as are velocities v: three by three Gauss points, exact where the corners
/// lie in a plane. The thickness adds t^2/12 along the normal to the second moments, and the turning of the
/// normal to the angular momentum.
void add_shell(const Quadrilateral& x, const Quadrilateral& v, Real t, MassIntegrals& sums);

using Hexahedron = std::array<Vec, 8>;  ///< corners in LS-DYNA's order; nodes may be repeated

/// Adds a hexahedron of unit density, interpolated trilinearly between its corners, as are velocities v:
/// three by three by three Gauss points, exact where its faces are not warped.
void add_solid(const Hexahedron& x, const Hexahedron& v, MassIntegrals& sums);

}  // namespace courant
