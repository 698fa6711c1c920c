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

/// True if an edge of f has all of g beyond it but for `overlap`.
bool an_edge_parts(const Facet& f, const Facet& g, Real overlap) {
  for (int e = 0; e < f.corners; ++e) {
    Real most = -std::numeric_limits<Real>::infinity();
    for (int c = 0; c < g.corners; ++c) most = std::max(most, f.inward[e].dot(g.x[c] - f.x[e]));
    if (most <= overlap) return true;
  }
  return false;
}

/// Takes every facet of the plane that overlaps another one out of it.
void drop_overlapping(const std::vector<Facet>& facets, std::vector<Index>& members, Real apart,
                      std::vector<Wall>& walls) {
  Real margin = 0;
  for (const Index s : members) margin = std::max(margin, 2 * (facets[s].tolerance + apart));
  for (const Index s : members) walls[s].margin = margin;
  const Real overlap = 0.5 * margin;
  Vec low = facets[members[0]].centre, high = low;
  for (const Index s : members) {
    low = low.cwiseMin(facets[s].centre);
    high = high.cwiseMax(facets[s].centre);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const auto start = [&](Index s) { return facets[s].centre[axis] - facets[s].radius; };
  std::sort(members.begin(), members.end(), [&](Index a, Index b) { return start(a) < start(b); });
  for (std::size_t a = 0; a < members.size(); ++a) {
    const Facet& f = facets[members[a]];
    for (std::size_t b = a + 1; b < members.size(); ++b) {
      if (start(members[b]) > f.centre[axis] + f.radius) break;
      const Facet& g = facets[members[b]];
      if ((f.centre - g.centre).squaredNorm() > (f.radius + g.radius) * (f.radius + g.radius)) continue;
      if (an_edge_parts(f, g, overlap) || an_edge_parts(g, f, overlap)) continue;
      walls[members[a]].plane = walls[members[b]].plane = -1;
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
    if (!plane.empty()) drop_overlapping(facets, plane, apart, walls);
}

}  // namespace courant
