#include "sph/walls/ghosts/wall_facet.hpp"

#include <algorithm>
#include <utility>

namespace courant {

WallFacet WallFacet::copied(const GhostPlane& plane, int side) const {
  WallFacet copy = *this;
  if (plane.kind == GhostPlane::Kind::mirror) {
    for (Vec& p : copy.x) p -= 2 * depth(plane, p) * plane.normal;
    copy.n -= 2 * n.dot(plane.normal) * plane.normal;
  } else {
    for (Vec& p : copy.x) p += (side == 0 ? 1 : -1) * plane.period * plane.normal;
  }
  return copy;
}

Real WallFacet::past_edges(const Vec& q) const {
  if (is_line) {
    const Vec along = (x[1] - x[0]).normalized();
    const Real s = (q - x[0]).dot(along);
    return std::max(-s, s - (x[1] - x[0]).norm());
  }
  Real most = -1e300;
  for (std::size_t e = 0; e < 3; ++e) {
    const Vec edge = x[(e + 1) % 3] - x[e];
    most = std::max(most, -n.cross(edge).normalized().dot(q - x[e]));
  }
  return most;
}

bool WallFacet::crosses(const Vec& from, const Vec& to) const {
  const Real a = n.dot(from - x[0]), b = n.dot(to - x[0]);
  return a * b < 0 && past_edges(from + a / (a - b) * (to - from)) <= 0;
}

Vec WallFacet::nearest(const Vec& from) const {
  const auto on_edge = [&](const Vec& a, const Vec& b) {
    const Real t = (from - a).dot(b - a) / (b - a).squaredNorm();
    return Vec(a + std::clamp(t, Real(0), Real(1)) * (b - a));
  };
  if (is_line) return on_edge(x[0], x[1]);
  const Vec foot = from - n.dot(from - x[0]) * n;
  if (past_edges(foot) <= 0) return foot;
  Vec best = on_edge(x[0], x[1]);
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 0}}) {
    const Vec q = on_edge(x[static_cast<std::size_t>(a)], x[static_cast<std::size_t>(b)]);
    if ((q - from).norm() < (best - from).norm()) best = q;
  }
  return best;
}

std::vector<Vec> WallFacet::samples(Real spacing) const {
  std::vector<Vec> out;
  const Vec e1 = x[1] - x[0];
  if (is_line) {
    const auto count = static_cast<int>(std::ceil(e1.norm() / spacing));
    for (int k = 0; k < count; ++k) out.emplace_back(x[0] + (k + 0.5) / count * e1);
    return out;
  }
  const Vec e2 = x[2] - x[0];
  const auto count =
      static_cast<int>(std::ceil(std::max({e1.norm(), e2.norm(), (e2 - e1).norm()}) / spacing));
  for (int a = 0; a < count; ++a)
    for (int b = 0; a + b < count; ++b)
      out.emplace_back(x[0] + (a + 1.0 / 3) / count * e1 + (b + 1.0 / 3) / count * e2);
  return out;
}

bool in_cone(const Vec& direction, const std::vector<Vec>& normals) {
  constexpr Real off_cone = 0.05;  // of 1
  std::vector<Real> weight(normals.size(), 0);
  Vec rest = direction;
  for (int round = 0; round < 40; ++round)
    for (std::size_t k = 0; k < normals.size(); ++k) {
      const Real change = std::max(weight[k] + normals[k].dot(rest), Real(0)) - weight[k];
      weight[k] += change, rest -= change * normals[k];
    }
  return rest.norm() < off_cone;
}

}  // namespace courant
