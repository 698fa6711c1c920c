#pragma once
// Data of a facet for the search, compact in memory, and the facets that are in one plane.
#include <algorithm>
#include <array>
#include <vector>

#include "contact/facet.hpp"

namespace courant {

struct Wall {
  Vec n = Vec::Zero();          ///< as in Facet [-]
  Real offset = 0;              ///< as in Facet [L]
  Real r = 0;                   ///< contact distance of the segment [L]
  Real k = 0;                   ///< stiffness of the segment [M/T2]
  std::array<Real, 4> sure{};   ///< see is_surely_over [L]
  std::array<Vec, 4> inward{};  ///< as in Facet; a triangle repeats the last [-]
  std::array<Real, 4> edge{};   ///< inward[e].x = edge[e] on edge e [L]
  Real tolerance = 0;           ///< as in Facet [L]
  Real margin = 0;              ///< what is further beyond the facet is not as deep as on the plane [L]
  Vec centre = Vec::Zero();     ///< as in Facet [L]
  Real radius = 0;              ///< as in Facet [L]
  Index plane = -1;             ///< see find_planes; -1: nothing is known
};

Wall make_wall(const Facet& facet);

inline Real plane_distance(const Wall& w, const Vec& y) {
  return w.n.dot(y) - w.offset;
}

/// Least distance of y's projection on the plane beyond the facet's edges; negative: inside. Exact except for
/// rounding inside and straight beyond an edge, a lower bound beyond corners. [L]
inline Real beyond_edges(const Wall& w, const Vec& y) {
  Real beyond = w.edge[0] - w.inward[0].dot(y);
  for (int e = 1; e < 4; ++e) beyond = std::max(beyond, w.edge[e] - w.inward[e].dot(y));
  return beyond;
}

/// Lower bound of the distance of y from the facet; up to Facet::tolerance beyond an edge counts as over it.
/// [L2]
inline Real least_distance2(const Wall& w, const Vec& y) {
  const Real a = plane_distance(w, y), beyond = std::max(beyond_edges(w, y) - w.tolerance, 0.0);
  return a * a + beyond * beyond;
}

/// For facets of a plane: true if y is over this one (to Facet::tolerance) and far enough from all facets of
/// the plane with lower numbers.
inline bool is_surely_over(const Wall& w, const Vec& y) {
  Real beyond = w.sure[0] - w.inward[0].dot(y);
  for (int e = 1; e < 4; ++e) beyond = std::max(beyond, w.sure[e] - w.inward[e].dot(y));
  return beyond <= 0;
}

/// Gives Wall::plane and Wall::sure: facets of one plane are fixed, touch at the same distance and do not
/// overlap. Within `reach` of two of them their plane distances differ, except for the sign, by less than
/// `same`; a point surely over one is beyond the tolerance of those with lower numbers, by more than `apart`.
/// [L]
void find_planes(const std::vector<Facet>& facets, Real reach, Real same, Real apart,
                 std::vector<Wall>& walls);

}  // namespace courant
