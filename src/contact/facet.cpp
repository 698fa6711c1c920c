#include "contact/facet.hpp"

#include <cmath>
#include <limits>

namespace courant {
namespace {

// Nodes in decks carry about 7 digits, so gaps between patches are below this fraction of the facet's size.
constexpr Real joint_tolerance = 1e-5;

Vec triangle_normal(const Vec& a, const Vec& b, const Vec& c) {
  return (b - a).cross(c - a);
}

bool is_flat_and_convex(const Corners& x) {
  const Vec n = (x[2] - x[0]).cross(x[3] - x[1]);
  const Real size = std::sqrt(n.norm());
  if (std::abs(n.normalized().dot(x[1] - x[0])) > 1e-6 * size) return false;
  if (std::abs(n.normalized().dot(x[3] - x[0])) > 1e-6 * size) return false;
  for (int e = 0; e < 4; ++e)
    if (triangle_normal(x[e], x[(e + 1) % 4], x[(e + 2) % 4]).dot(n) <= 1e-9 * n.squaredNorm()) return false;
  return true;
}

}  // namespace

void update_facet(Facet& f, const Nodes& nodes) {
  Vec centre = Vec::Zero();
  for (int e = 0; e < 4; ++e) f.x[e] = at_corner(f, e, [&](Index n) { return nodes.x.vec(n); });
  for (int e = 0; e < f.corners; ++e) centre += f.x[e] / f.corners;
  const Vec n = f.corners == 4 ? Vec((f.x[2] - f.x[0]).cross(f.x[3] - f.x[1]))
                               : triangle_normal(f.x[0], f.x[1], f.x[2]);
  f.n = n.normalized();
  f.centre = centre;
  f.offset = f.n.dot(centre);
  f.radius = 0;
  for (int e = 0; e < f.corners; ++e) {
    f.radius = std::max(f.radius, (f.x[e] - centre).norm());
    f.inward[e] = f.n.cross(f.x[(e + 1) % f.corners] - f.x[e]).normalized();
  }
  f.tolerance = joint_tolerance * f.radius;
}

std::vector<Facet> make_facets(const World& world, const std::vector<Index>& segments,
                               const std::function<bool(Index node)>& deforms) {
  std::vector<Facet> out;
  out.reserve(segments.size());
  const auto add = [&](Index s, std::array<Index, 4> node, int corners, bool centred = false) {
    Facet f;
    f.segment = s;
    f.node = node;
    f.corners = corners;
    f.centred = centred;
    for (int e = 0; e < node_count(f); ++e) f.moves = f.moves || !world.nodes.held[node[e]];
    update_facet(f, world.nodes);
    if (f.n.squaredNorm() > 0.5)
      out.push_back(f);  // a segment without area has no normal and cannot be touched
  };
  for (const Index s : segments) {
    const auto a = world.segments.nodes(s);
    Corners x;
    for (int e = 0; e < 4; ++e) x[e] = world.nodes.x.vec(a[e]);
    if (a[2] == a[3]) {
      add(s, a, 3);
    } else if (std::any_of(a.begin(), a.end(), deforms)) {
      for (int e = 0; e < 4; ++e) add(s, {a[e], a[(e + 1) % 4], a[(e + 2) % 4], a[(e + 3) % 4]}, 3, true);
    } else if (is_flat_and_convex(x)) {
      add(s, a, 4);
    } else {
      // The diagonal on whose two sides the triangles face the same way; for a warped convex quad either
      // does.
      const bool first = triangle_normal(x[0], x[1], x[2]).dot(triangle_normal(x[0], x[2], x[3])) >=
                         triangle_normal(x[1], x[2], x[3]).dot(triangle_normal(x[1], x[3], x[0]));
      const int o = first ? 0 : 1;
      add(s, {a[o], a[o + 1], a[o + 2], a[o + 2]}, 3);
      add(s, {a[o], a[o + 2], a[(o + 3) % 4], a[(o + 3) % 4]}, 3);
    }
  }
  return out;
}

Vec nearest_on_rim(const Facet& f, const Vec& y) {
  Vec best = f.x[0];
  Real least = std::numeric_limits<Real>::infinity();
  for (int e = 0; e < f.corners; ++e) {
    const Vec& a = f.x[e];
    const Vec edge = f.x[e + 1 == f.corners ? 0 : e + 1] - a;
    const Real t = std::clamp(edge.dot(y - a) / edge.squaredNorm(), 0.0, 1.0);
    const Vec q = a + t * edge;
    const Real d2 = (y - q).squaredNorm();
    if (d2 < least) {
      least = d2;
      best = q;
    }
  }
  return best;
}

bool passes_through(const Facet& f, const Corners& before, int side, const Vec& from, const Vec& to,
                    Real& fraction) {
  const Vec n0 = f.corners == 4 ? Vec((before[2] - before[0]).cross(before[3] - before[1]))
                                : triangle_normal(before[0], before[1], before[2]);
  const Real d0 = std::max(side * n0.normalized().dot(from - before[0]), 0.0);
  const Real d1 = side * plane_distance(f, to);
  if (d1 > 0) return false;
  const Real t = d0 - d1 > 0 ? d0 / (d0 - d1) : 0.0;
  const Vec p = from + t * (to - from);
  const auto corner = [&](int e) -> Vec { return before[e] + t * (f.x[e] - before[e]); };
  for (int e = 0; e < f.corners; ++e) {
    const Vec a = corner(e);
    const Vec edge = corner((e + 1) % f.corners) - a;
    // Generous by ten tolerances: a path through the joint of two patches must be seen by one of them.
    if (f.n.cross(edge).dot(p - a) < -10 * f.tolerance * edge.norm()) return false;
  }
  fraction = t;
  return true;
}

std::array<Real, 4> shape_functions(const Facet& f, const Vec& q) {
  if (f.corners == 3) {
    const Vec n = triangle_normal(f.x[0], f.x[1], f.x[2]);
    const Real a = triangle_normal(q, f.x[1], f.x[2]).dot(n) / n.squaredNorm();
    const Real b = triangle_normal(q, f.x[2], f.x[0]).dot(n) / n.squaredNorm();
    const Real c = 1 - a - b;
    if (f.centred) return {a + 0.25 * c, b + 0.25 * c, 0.25 * c, 0.25 * c};
    return {a, b, c, 0};
  }
  // Inverse bilinear map by Newton's method in the facet's plane; exact in one step for parallelograms.
  const Vec e1 = (f.x[1] - f.x[0]).normalized(), e2 = f.n.cross(e1);
  Real s = 0, t = 0;
  std::array<Real, 4> N{};
  for (int it = 0; it < 12; ++it) {
    N = {0.25 * (1 - s) * (1 - t), 0.25 * (1 + s) * (1 - t), 0.25 * (1 + s) * (1 + t),
         0.25 * (1 - s) * (1 + t)};
    const Vec gap = q - (N[0] * f.x[0] + N[1] * f.x[1] + N[2] * f.x[2] + N[3] * f.x[3]);
    const Real g1 = gap.dot(e1), g2 = gap.dot(e2);
    if (g1 * g1 + g2 * g2 < 1e-26 * f.radius * f.radius) return N;
    const Vec xs = 0.25 * ((1 - t) * (f.x[1] - f.x[0]) + (1 + t) * (f.x[2] - f.x[3]));
    const Vec xt = 0.25 * ((1 - s) * (f.x[3] - f.x[0]) + (1 + s) * (f.x[2] - f.x[1]));
    const Real a = xs.dot(e1), b = xt.dot(e1), c = xs.dot(e2), d = xt.dot(e2), det = a * d - b * c;
    if (!(std::abs(det) > 1e-14 * f.radius * f.radius)) break;
    s += (d * g1 - b * g2) / det;
    t += (a * g2 - c * g1) / det;
  }
  if (std::isfinite(s) && std::isfinite(t) && std::abs(s) < 4 && std::abs(t) < 4) return N;
  return {0.25, 0.25, 0.25, 0.25};
}

}  // namespace courant
