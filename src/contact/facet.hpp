#pragma once
// A flat convex face that particles can touch: a triangle, a flat quad, one half of a warped quad, or a
// fourth of one that deforms.
#include <algorithm>
#include <array>
#include <functional>
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
  bool centred = false;         ///< a triangle of which the third corner is the middle of the four nodes
  Index segment = 0;            ///< index into World::segments
  bool moves = false;           ///< some node belongs to a body that can move
  Real r = 0;                   ///< contact distance of the segment, half its thickness [L]
  Real k = 0;                   ///< stiffness of the segment, SLSFAC and SFSB included [M/T2]
  Real m = 0;                   ///< least mass of its nodes, infinity where they cannot move [M]
  Index body = -1;              ///< rigid body it belongs to; -1: none
};

/// Number of nodes that move the facet.
inline int node_count(const Facet& f) {
  return f.centred ? 4 : f.corners;
}
/// Value at a corner of a vector given at nodes.
template <class OfNode>
Vec at_corner(const Facet& f, int corner, const OfNode& of_node) {
  if (!f.centred || corner < 2) return of_node(f.node[std::min(corner, f.corners - 1)]);
  return 0.25 * (of_node(f.node[0]) + of_node(f.node[1]) + of_node(f.node[2]) + of_node(f.node[3]));
}

/// Facets of the given segments with their present shape. Flat convex quads remain one facet, others become
/// two triangles. Those with a node for which `deforms` holds become four around their middle; forces on
/// nodes then correspond to the positions of the facets at any warp. Only geometry, node, segment and moves
/// are filled.
std::vector<Facet> make_facets(
    const World& world, const std::vector<Index>& segments,
    const std::function<bool(Index node)>& deforms = [](Index) { return false; });

/// Takes plane, circle and edges from the nodes' positions.
void update_facet(Facet& facet, const Nodes& nodes);

inline Real plane_distance(const Facet& f, const Vec& y) {
  return f.n.dot(y) - f.offset;
}

/// +1 or -1; a point in the plane counts as in front.
inline int side_of(Real plane_distance) {
  return plane_distance < 0 ? -1 : 1;
}

/// True if y's projection on the plane falls on the facet (its edges included).
inline bool is_over(const Facet& f, const Vec& y) {
  for (int e = 0; e < f.corners; ++e)
    if (f.inward[e].dot(y - f.x[e]) < -f.tolerance) return false;
  return true;
}

/// Point of the facet's edges nearest to y [L].
Vec nearest_on_rim(const Facet& f, const Vec& y);

/// True if the point that goes from `from` to `to` while the corners go from `before` to f.x passes through
/// the facet. `side` is the side of `from`; it counts where `from` is in the plane except for rounding.
/// `fraction` (0 to 1) is the time in the step.
bool passes_through(const Facet& f, const Corners& before, int side, const Vec& from, const Vec& to,
                    Real& fraction);

/// Weights of the facet's nodes at a point of its plane (linear or bilinear); their sum is 1. shape: its
/// nodes [-]
std::array<Real, 4> shape_functions(const Facet& f, const Vec& q);

}  // namespace courant
