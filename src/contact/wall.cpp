#include "contact/wall.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace courant {
namespace {

/// The same for facets of one plane whichever way they face; a plane that falls between two roundings becomes
/// two planes, which costs time only.
using Key = std::array<std::int64_t, 5>;

Real facing(const Vec& n) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(n[k]) > 1e-3) return n[k] < 0 ? -1 : 1;
  return 1;
}

std::int64_t rounded(Real value) {
  return std::int64_t(std::llround(std::clamp(value, -4e18, 4e18)));
}

Key key_of(const Facet& f, Real unit) {
  const Real s = facing(f.n);
  return {rounded(s * f.n[0] * 0.917e8), rounded(s * f.n[1] * 0.917e8), rounded(s * f.n[2] * 0.917e8),
          rounded(s * f.offset / unit), rounded(f.r / unit)};
}

bool same_plane(const Facet& first, const Facet& f, Real reach, Real same) {
  const Real s = facing(first.n) * facing(f.n);
  if (first.r != f.r) return false;
  if ((first.n - s * f.n).norm() * (reach + 2 * f.radius) > 0.15 * same) return false;
  for (int e = 0; e < f.corners; ++e)
    if (std::abs(plane_distance(first, f.x[e])) + std::abs(plane_distance(f, f.x[e])) > 0.3 * same)
      return false;
  return true;
}

/// How far all of g is beyond edge e of f.
Real how_far_beyond(const Facet& f, int e, const Facet& g) {
  Real least = std::numeric_limits<Real>::infinity();
  for (int c = 0; c < g.corners; ++c) least = std::min(least, f.inward[e].dot(f.x[e] - g.x[c]));
  return least;
}

/// The edge of f that has g furthest beyond it.
int parting_edge(const Facet& f, const Facet& g, Real& beyond) {
  int best = 0;
  beyond = -std::numeric_limits<Real>::infinity();
  for (int e = 0; e < f.corners; ++e) {
    const Real now = how_far_beyond(f, e, g);
    if (now > beyond) beyond = now, best = e;
  }
  return best;
}

/// Where the later one of two facets may be on the earlier one, too, it is not sure. Facets that overlap
/// leave the plane.
void keep_apart(const std::vector<Facet>& facets, Index earlier, Index later, Real margin,
                std::vector<Wall>& walls) {
  Real beyond = 0, other = 0;
  const int e = parting_edge(facets[later], facets[earlier], beyond);
  parting_edge(facets[earlier], facets[later], other);
  if (std::max(beyond, other) < -0.5 * margin) {
    walls[earlier].plane = walls[later].plane = -1;
    return;
  }
  Wall& w = walls[later];
  const bool parted = beyond >= -0.5 * margin;
  for (int k = 0; k < 4; ++k)
    if (!parted || k == e)
      w.sure[k] = std::max(w.sure[k], w.edge[k] + (parted ? 0.5 * margin - beyond : margin));
}

void part_facets(const std::vector<Facet>& facets, std::vector<Index>& members, Real apart,
                 std::vector<Wall>& walls) {
  Real margin = 0;
  Vec low = facets[members[0]].centre, high = low;
  for (const Index s : members) {
    margin = std::max(margin, 2 * (facets[s].tolerance + apart));
    for (int e = 0; e < 4; ++e) walls[s].sure[e] = walls[s].edge[e] - 0.5 * walls[s].tolerance;
    low = low.cwiseMin(facets[s].centre);
    high = high.cwiseMax(facets[s].centre);
  }
  for (const Index s : members) walls[s].margin = margin;
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const auto start = [&](Index s) { return facets[s].centre[axis] - facets[s].radius; };
  std::sort(members.begin(), members.end(), [&](Index a, Index b) { return start(a) < start(b); });
  for (std::size_t a = 0; a < members.size(); ++a) {
    const Facet& f = facets[members[a]];
    for (std::size_t b = a + 1; b < members.size(); ++b) {
      if (start(members[b]) > f.centre[axis] + f.radius + 2 * margin) break;
      const Facet& g = facets[members[b]];
      const Real near = f.radius + g.radius + 2 * margin;
      if ((f.centre - g.centre).squaredNorm() > near * near) continue;
      keep_apart(facets, std::min(members[a], members[b]), std::max(members[a], members[b]), margin, walls);
    }
  }
}

}  // namespace

Wall make_wall(const Facet& f) {
  Wall w;
  w.n = f.n;
  w.offset = f.offset;
  w.r = f.r;
  w.k = f.k;
  w.tolerance = f.tolerance;
  w.centre = f.centre;
  w.radius = f.radius;
  for (int e = 0; e < 4; ++e) {
    const int from = std::min(e, f.corners - 1);
    w.inward[e] = f.inward[from];
    w.edge[e] = w.inward[e].dot(f.x[from]);
  }
  return w;
}

void find_planes(const std::vector<Facet>& facets, Real reach, Real same, Real apart,
                 std::vector<Wall>& walls) {
  std::map<Key, Index> plane_of_key;
  std::vector<std::vector<Index>> members;
  for (Index s = 0; s < Index(facets.size()); ++s) {
    if (facets[s].moves) continue;
    const auto [at, is_new] =
        plane_of_key.try_emplace(key_of(facets[s], 12.3 * apart), Index(members.size()));
    if (is_new) members.emplace_back();
    std::vector<Index>& plane = members[at->second];
    if (!same_plane(facets[plane.empty() ? s : plane[0]], facets[s], reach, same)) continue;
    walls[s].plane = at->second;
    plane.push_back(s);
  }
  for (std::vector<Index>& plane : members)
    if (!plane.empty()) part_facets(facets, plane, apart, walls);
}

}  // namespace courant
