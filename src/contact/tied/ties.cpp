#include "contact/tied/ties.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "contact/nodes/face.hpp"

namespace courant {

namespace {

Real shortest_diagonal(const FaceCorners& x, int corners) {
  if (corners == 3) return std::min({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
  return std::min((x[2] - x[0]).norm(), (x[3] - x[1]).norm());
}

/// Without the thickness of a node. [L]
Real tolerance_of(const TieFace& f, Real given, const Field<Real>& x) {
  return given > 0 ? given : 0.05 * shortest_diagonal(corners_of(f, x), f.corners);
}

/// Area of the node's own faces that look along the normal of the face, or against it; where there are none,
/// its share of the face. The softer side gives the stiffness.
void take_area(const TieNode& node, const TieFace& f, const Vec& n, Tie& tie) {
  constexpr Real alike = 0.5;  // cosine
  tie.area = tie.cell = 0;
  Real stiffness = f.k, count = 0;
  for (const TieNode::OwnFace& own : node.own) {
    const Real along = std::abs(own.area.dot(n));
    if (along < alike * own.area.norm()) continue;
    tie.area += along / own.corners, tie.cell += along, ++count;
    stiffness = std::min(stiffness, own.stiffness);
  }
  if (count > 0) tie.cell /= count;
  if (tie.area == 0) tie.area = f.area / f.corners;
  tie.k = tie.area * stiffness;
}

}  // namespace

Tie tie_at(const TieNode& node, const TieFace& face, const Projection& at, const Field<Real>& x) {
  Tie tie{.node = node.node,
          .segment = face.segment,
          .at = face_point(face, at, at.n.dot(x.vec(node.node) - at.q))};
  if (face.two_sided && tie.at.gap < 0) tie.side = -1;
  take_area(node, face, at.n, tie);
  return tie;
}

std::vector<Tie> find_ties(const std::vector<TieNode>& nodes, const std::vector<TieFace>& faces, Real given,
                           const Field<Real>& x, std::vector<Index>* corners_near) {
  std::set<Index> corners;
  std::vector<Real> tolerance;
  Real thickest = 0, reach = 0;
  for (const TieNode& n : nodes) thickest = std::max(thickest, n.thickness);
  for (const TieFace& f : faces) {
    corners.insert(f.node.begin(), f.node.end());
    tolerance.push_back(tolerance_of(f, given, x));
    reach = std::max({reach, tolerance.back(), given > 0 ? 0 : 0.6 * (thickest + 2 * f.r),
                      2 * edge_margin * longest_diagonal(corners_of(f, x), f.corners)});
  }
  BoxGrid search;
  search.build(boxes_around(faces, x, reach, reach));
  std::vector<Tie> out;
  for (const TieNode& n : nodes) {
    const Vec y = x.vec(n.node);
    Real nearest = std::numeric_limits<Real>::infinity();
    Tie best{.node = n.node};
    search.near(y, [&](Index k) {
      const TieFace& f = faces[static_cast<std::size_t>(k)];
      if (f.has(n.node)) return;
      const Projection p = project(corners_of(f, x), f.corners, y);
      const Real gap = p.n.dot(y - p.q);
      Real most = tolerance[static_cast<std::size_t>(k)];
      if (!(given > 0)) most = std::max(most, 0.6 * (n.thickness + 2 * f.r));
      if (!p.over || std::abs(gap) > most || !(std::abs(gap) < nearest)) return;
      nearest = std::abs(gap);
      best = tie_at(n, f, p, x);
    });
    if (!std::isfinite(nearest)) continue;
    if (!corners.contains(n.node))
      out.push_back(best);
    else if (corners_near)
      corners_near->push_back(n.node);
  }
  return out;
}

TieShares::TieShares(const std::vector<Tie>& ties, bool of_nodes, Index nodes)
    : first_(static_cast<std::size_t>(nodes) + 1, 0) {
  const auto each = [&](const auto& work) {
    for (std::size_t t = 0; t < ties.size(); ++t) {
      if (of_nodes) work(ties[t].node, Share{static_cast<Index>(t), -1});
      for (int e = 0; e < ties[t].at.corners; ++e)
        work(ties[t].at.node[static_cast<std::size_t>(e)], Share{static_cast<Index>(t), e});
    }
  };
  each([&](Index n, const Share&) { ++first_[static_cast<std::size_t>(n) + 1]; });
  for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
  shares_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  each([&](Index n, const Share& share) {
    shares_[static_cast<std::size_t>(next[static_cast<std::size_t>(n)]++)] = share;
  });
}

}  // namespace courant
