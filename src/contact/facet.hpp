#pragma once
// A flat convex face that particles can touch: a triangle, a flat quad, or one half of a warped quad.
#include <array>
#include <vector>

#include "state/world.hpp"

namespace courant {

using Corners = std::array<Vec, 4>;  ///< a triangle repeats its last corner [L]

struct Facet {
  Vec n = Vec::Zero();       ///< unit normal [-]
  Real offset = 0;           ///< the plane is n.x = offset [L]
  Vec centre = Vec::Zero();  ///< of a circle around all corners [L]
  Real radius = 0;           ///< [L]
  Corners x{};               ///< corners, counter-clockwise about n [L]
  Corners inward{};          ///< unit vectors in the plane, into the facet from edge x[e], x[e+1] [-]
  Real tolerance = 0;  ///< lengths below this are zero: patches whose nodes are not merged still join [L]
  int corners = 3;
  std::array<Index, 4> node{};  ///< indices into World::nodes
  Index segment = 0;            ///< index into World::segments
  bool moves = false;           ///< some node belongs to a body that can move
  Real r = 0;                   ///< contact distance of the segment, half its thickness [L]
  Real k = 0;                   ///< stiffness of the segment, SLSFAC and SFSB included [M/T2]
  Real m = 0;                   ///< least mass of its nodes, infinity where they cannot move [M]
  Index body = -1;              ///< rigid body it belongs to; -1: none
};

/// Facets of the given segments with their present shape. Flat convex quads stay whole, others become two
/// triangles. Only geometry, node, segment and moves are filled.
std::vector<Facet> make_facets(const World& world, const std::vector<Index>& segments);

/// Takes plane, circle and edges from the nodes' positions.
void update_facet(Facet& facet, const Nodes& nodes);

inline Real plane_distance(const Facet& f, const Vec& y) {
  return f.n.dot(y) - f.offset;
}

/// +1 or -1; a point in the plane counts as in front.
inline int side_of(Real plane_distance) {
  return plane_distance < 0 ? -1 : 1;
}

/// True if y's projection on the plane falls on the facet (its rim included).
inline bool is_over(const Facet& f, const Vec& y) {
  for (int e = 0; e < f.corners; ++e)
    if (f.inward[e].dot(y - f.x[e]) < -f.tolerance) return false;
  return true;
}

/// Point of the facet's edges nearest to y [L].
Vec nearest_on_rim(const Facet& f, const Vec& y);

/// True if the point that goes from `from` to `to` while the corners go from `before` to f.x passes through
/// the facet. `side` is the side of `from`; it decides where `from` is in the plane but for rounding.
/// `fraction` (0 to 1) tells when.
bool passes_through(const Facet& f, const Corners& before, int side, const Vec& from, const Vec& to,
                    Real& fraction);

/// Shape functions of the facet's corners at a point of its plane (linear or bilinear); they sum to 1. shape:
/// corners [-]
std::array<Real, 4> shape_functions(const Facet& f, const Vec& q);

}  // namespace courant
