#include "sph/walls/ghosts/shell_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace courant {

namespace {

class FacetBuilder {
 public:
  FacetBuilder(const World& world, const GhostLattice& lattice) : world_(world), to_(lattice) {}

  void add_shell(Index segment) {
    const auto nodes = world_.segments.nodes(segment);
    std::array<Vec, 4> x;
    for (std::size_t e = 0; e < 4; ++e) {
      x[e] = world_.nodes.x.vec(nodes[e]);
      if (to_.dim == 2) x[e][2] = 0;
    }
    WallFacet f;
    f.segment = segment;
    f.is_line = to_.dim == 2;
    f.part = world_.segments.part[segment];
    if (to_.dim == 2) {  // the line that the shell has in the plane of the flow
      Vec a = x[0], b = x[0];
      for (const Vec& p : x)
        if ((p - a).norm() > (b - a).norm()) b = p;
      if (!((b - a).norm() > facet_tolerance * to_.spacing)) return;  // it lies in the plane
      f.x = {a, b, b};
      f.n = Vec(a[1] - b[1], b[0] - a[0], 0).normalized();
      return add(f);
    }
    for (const auto& [second, third] : {std::pair{1, 2}, {2, 3}}) {
      f.x = {x[0], x[static_cast<std::size_t>(second)], x[static_cast<std::size_t>(third)]};
      const Vec area = (f.x[1] - f.x[0]).cross(f.x[2] - f.x[0]);
      if (!(area.norm() > 1e-12 * to_.spacing * to_.spacing)) continue;
      f.n = area.normalized();
      add(f);
    }
  }

  /// With copies of copies, of planes added before.
  void add_copies(const GhostPlane& plane) {
    const auto count = static_cast<Index>(facets_.size());
    const int sides = plane.kind == GhostPlane::Kind::mirror ? 1 : 2;
    for (Index k = 0; k < count; ++k)
      for (int side = 0; side < sides; ++side) {
        const WallFacet f = facets_[static_cast<std::size_t>(k)];
        Real least = 1e300;
        for (const Vec& x : f.x)
          least = std::min(least, side == 0 ? depth(plane, x) : plane.period - depth(plane, x));
        if (!(least < to_.reach + 2 * to_.spacing)) continue;
        facets_.push_back(f.copied(plane, side));
        facets_.back().copy_of = f.copy_of >= 0 ? f.copy_of : k;
      }
  }
  std::vector<WallFacet> take() { return std::move(facets_); }

 private:
  void add(const WallFacet& f) {
    if (!are_beyond(to_.planes, {f.x[0], f.x[1], f.x[2]}, -facet_tolerance * to_.spacing))
      facets_.push_back(f);
  }

  const World& world_;
  const GhostLattice& to_;
  std::vector<WallFacet> facets_;
};

}  // namespace

std::vector<WallFacet> facets_of_shells(const World& world, const std::vector<Index>& segments,
                                        const GhostLattice& lattice) {
  FacetBuilder builder(world, lattice);
  for (const Index s : segments) builder.add_shell(s);
  for (const GhostPlane& plane : lattice.planes) builder.add_copies(plane);
  return builder.take();
}

bool is_beyond(const std::vector<GhostPlane>& planes, const Vec& x, Real margin) {
  return are_beyond(planes, {x}, margin);
}

bool are_beyond(const std::vector<GhostPlane>& planes, const std::vector<Vec>& points, Real margin) {
  const auto all = [&](const auto& is) { return std::all_of(points.begin(), points.end(), is); };
  return std::any_of(planes.begin(), planes.end(), [&](const GhostPlane& plane) {
    if (all([&](const Vec& x) { return depth(plane, x) < -margin; })) return true;
    return plane.kind == GhostPlane::Kind::periodic &&
           all([&](const Vec& x) { return depth(plane, x) > plane.period + margin; });
  });
}

std::map<Index, bool> closed_parts(const std::vector<WallFacet>& facets, const GhostLattice& lattice) {
  using Corner = std::array<std::int64_t, 3>;
  const Real dx = lattice.spacing;
  const auto corner = [&](const Vec& x) {
    Corner c{};
    for (std::size_t k = 0; k < 3; ++k) c[k] = std::llround(x[static_cast<Index>(k)] / (0.01 * dx));
    return c;
  };
  const auto on_plane = [&](const std::vector<Vec>& x) {
    return are_beyond(lattice.planes, x, -facet_tolerance * dx);
  };
  std::map<Index, std::map<std::pair<Corner, Corner>, int>> edges;
  for (const WallFacet& f : facets) {
    if (f.copy_of >= 0) continue;
    auto& of = edges[f.part];
    if (f.is_line) {
      for (const Vec& x : {f.x[0], f.x[1]})
        if (!on_plane({x})) ++of[{corner(x), corner(x)}];
      continue;
    }
    for (std::size_t e = 0; e < 3; ++e) {
      if (on_plane({f.x[e], f.x[(e + 1) % 3]})) continue;
      const Corner a = corner(f.x[e]), b = corner(f.x[(e + 1) % 3]);
      ++of[{std::min(a, b), std::max(a, b)}];
    }
  }
  std::map<Index, bool> closed;
  for (const auto& [part, of] : edges)
    closed[part] = std::all_of(of.begin(), of.end(), [](const auto& edge) { return edge.second % 2 == 0; });
  return closed;
}

}  // namespace courant
