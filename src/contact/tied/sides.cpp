#include "contact/tied/sides.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

Real TieSides::thickness(Index s, Real given, Real scale) const {
  const Segments& g = world_.segments;
  if (g.volume[s] > 0) return 0;
  return given > 0 ? given : g.thickness[s] * scale;
}

/// Per area: K A/V of a solid, K/(longest diagonal) of a shell. [M/L2T2]
Real TieSides::stiffness(Index s, Real area) const {
  const Segments& g = world_.segments;
  if (g.volume[s] > 0) return g.K[s] * area / g.volume[s];
  const auto a = g.nodes(s);
  return g.K[s] / longest_diagonal(corners_at(s), a[2] == a[3] ? 3 : 4);
}

FaceCorners TieSides::corners_at(Index s) const {
  const auto a = world_.segments.nodes(s);
  const Field<Real>& x = world_.nodes.x;
  return {x.vec(a[0]), x.vec(a[1]), x.vec(a[2]), x.vec(a[3])};
}

std::vector<TieFace> TieSides::faces(const ContactCard& c, const std::vector<Index>& segments) const {
  std::vector<TieFace> out;
  for (const Index s : segments) {
    TieFace& f = out.emplace_back();
    f.node = world_.segments.nodes(s), f.segment = s;
    f.two_sided = !(world_.segments.volume[s] > 0);
    f.corners = f.node[2] == f.node[3] ? 3 : 4;
    f.area = area_of(corners_at(s));
    f.r = 0.5 * thickness(s, c.sbst, c.sfsbt);
    f.k = c.sfsb * stiffness(s, f.area);
  }
  return out;
}

std::vector<TieNode> TieSides::nodes(const ContactCard& c, const std::vector<Index>& nodes,
                                     const std::vector<Index>& around) const {
  std::vector<TieNode> of_world(static_cast<std::size_t>(world_.nodes.size())), out;
  for (const Index s : around) {
    const auto a = world_.segments.nodes(s);
    const FaceCorners x = corners_at(s);
    const Real area = area_of(x);
    const int corners = a[2] == a[3] ? 3 : 4;
    const Vec normal = 0.5 * (x[2] - x[0]).cross(x[3] - x[1]);
    for (std::size_t e = 0; e < static_cast<std::size_t>(corners); ++e) {
      TieNode& n = of_world[static_cast<std::size_t>(a[e])];
      n.own.push_back({normal, corners, c.sfsa * stiffness(s, area)});
      n.thickness = std::max(n.thickness, thickness(s, c.sast, c.sfsat));
    }
  }
  for (const Index n : nodes) {
    out.push_back(of_world[static_cast<std::size_t>(n)]);
    out.back().node = n;
  }
  return out;
}

}  // namespace courant
