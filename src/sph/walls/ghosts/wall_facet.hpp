#pragma once
// The geometry of flat pieces of wall, behind which ghosts are laid.
#include <array>
#include <cmath>
#include <vector>

#include "search/ghosts.hpp"

namespace courant {

/// A triangle; of a wall in the plane a line, the first two points.
struct WallFacet {
  std::array<Vec, 3> x{Vec::Zero(), Vec::Zero(), Vec::Zero()};
  Vec n = Vec::Zero();
  bool is_line = false;
  Index segment = 0;
  Index part = 0;
  Index copy_of = -1;         ///< the facet of which it is a copy behind a plane; -1: it is none
  bool wet[2]{false, false};  ///< whether water can reach its side along n, and the other one

  /// What the flow that is continued behind a plane has there; `side` 1 of periodic planes: before it.
  WallFacet copied(const GhostPlane& plane, int side) const;

  bool used() const { return wet[0] != wet[1]; }
  /// 1 where n points out of the water, -1 else.
  Real outwards() const { return wet[1] ? 1 : -1; }
  /// How far q, in the plane of the facet, is outside of its edges; < 0: inside. [L]
  Real past_edges(const Vec& q) const;
  /// Whether the straight line between two points goes through it.
  bool crosses(const Vec& from, const Vec& to) const;
  /// The point of it next to `from`.
  Vec nearest(const Vec& from) const;
  /// Points of it, at most `spacing` apart. [L]
  std::vector<Vec> samples(Real spacing) const;
};

/// Whether a direction is a sum of these unit vectors with weights >= 0, found by descent along each in turn.
bool in_cone(const Vec& direction, const std::vector<Vec>& normals);

}  // namespace courant
