#pragma once
// A face of an element that nodes touch: bilinear, for any warp.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "search/box_grid.hpp"
#include "state/world.hpp"

namespace courant {

/// What does not change of a face.
struct ContactFace {
  std::array<Index, 4> node{};  ///< indices into World::nodes; a triangle repeats its third
  int corners = 4;
  Index segment = 0;       ///< index into World::segments
  bool two_sided = false;  ///< a shell; the face of a solid is touched from outside only
  Real r = 0;              ///< nodes touch it at this distance, half its thickness [L]
  Real lift = 0;           ///< height over its nodes from which that counts, by CNTCO [L]
  Real k = 0;              ///< K A^2/V of a solid, K A/(longest diagonal) of a shell [M/T2]
  Real area = 0;           ///< at the start [L2]
  Real depth = 0;          ///< of the element behind it, the search depth for nodes without contact [L]
  Real through = 0;        ///< depth beyond which a node in contact has leaked [L]
  unsigned passes = 0;     ///< bit p: nodes of pass p touch it
  bool has(Index n) const { return node[0] == n || node[1] == n || node[2] == n || node[3] == n; }
  int shared(const ContactFace& other) const {  ///< corners that both have
    int count = 0;
    for (int e = 0; e < corners; ++e) count += other.has(node[static_cast<std::size_t>(e)]);
    return count;
  }
};

/// Faces reach this far beyond their edges, of their width: over faces that continue there, and for ties.
inline constexpr Real edge_margin = 0.0125;

/// A node that slides off an outer edge is pushed in full up to here beyond it. [L]
inline Real edge_of(const ContactFace& f) {
  return 2 * edge_margin * std::sqrt(f.area);
}

/// A node that slides off an outer edge is pushed until it is as far beside it as it is deep, but no further
/// than half a width. [L]
inline Real fading_length(const ContactFace& f, Real depth) {
  return std::min(depth, 0.5 * std::sqrt(f.area));
}

/// What goes over an edge is level with what is behind it within this: twice what contact is deep there, as
/// far as that is more than rounding and less than a tenth of a width. [L]
inline Real level_at(Real depth, Real width) {
  return std::clamp(2 * depth, 1e-6 * width, 0.1 * width);
}

using FaceCorners = std::array<Vec, 4>;

/// The point of a face nearest to a position. Beyond an edge: still that of the bilinear map while `over`
/// holds, else the nearest point of the edges.
struct Projection {
  Vec q = Vec::Zero();      ///< [L]
  Vec n = Vec::Zero();      ///< unit normal of the face there [-]
  std::array<Real, 4> N{};  ///< shape functions there, which sum to 1 [-]
  bool inside = false;      ///< within the face
  bool within = false;      ///< the same, by more than rounding
  bool over = false;        ///< within the face, or beyond an edge by less than `edge_margin`
  unsigned beyond = 0;      ///< bit e: over, but beyond edge e (from corner e on) by more than rounding
  /// Whether both are one point, within `tolerance`. [L]
  bool meets(const Projection& other, Real tolerance) const { return (q - other.q).norm() <= tolerance; }
};

/// Unit normal of the plane along both diagonals.
inline Vec plane_normal(const FaceCorners& x) {
  return (x[2] - x[0]).cross(x[3] - x[1]).normalized();
}
/// Mean of the corners. [L]
inline Vec centre_of(const FaceCorners& x, int corners) {
  return corners == 4 ? Vec(0.25 * (x[0] + x[1] + x[2] + x[3])) : Vec((x[0] + x[1] + x[2]) / 3);
}
Projection project(const FaceCorners& x, int corners, const Vec& y);
/// The same where the position is over the face; else nothing holds but that it is not.
Projection project_over(const FaceCorners& x, int corners, const Vec& y);
/// The nearest point of the plane that goes on from the nearest point of the edges, along the diagonals, with
/// N that go on with it; returns the way there from the edge, 0 where it would lead inwards. [L] Not along
/// the bilinear face, which warps ever more beyond its edges.
Vec project_beyond(const FaceCorners& x, int corners, const Vec& y, Projection& p);
/// The nearest point of the edges, with the normal of the face there.
Projection project_on_rim(const FaceCorners& x, int corners, const Vec& y);

/// How the shape functions of the plane along both diagonals (of a triangle: its plane) change along a vector
/// in it, times the length of that. [-]
std::array<Real, 4> plane_change(const FaceCorners& x, int corners, const Vec& along);

template <class Face>
FaceCorners corners_of(const Face& f, const Field<Real>& x) {
  return {x.vec(f.node[0]), x.vec(f.node[1]), x.vec(f.node[2]), x.vec(f.node[3])};
}

/// Boxes that reach `reach` further than faces and their r; where `part` of a depth is beyond `least`, by the
/// difference more. [L] On all threads.
std::vector<BoxGrid::Box> boxes_around(const std::vector<ContactFace>& faces, const Field<Real>& x,
                                       Real reach, Real least, Real part = 1);

/// Area of a face, and its longest diagonal (of a triangle: side). [L2], [L]
Real area_of(const FaceCorners& x);
Real longest_diagonal(const FaceCorners& x, int corners);

}  // namespace courant
