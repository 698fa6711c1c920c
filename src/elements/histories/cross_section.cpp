#include "elements/histories/cross_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "model/mesh/solid_edges.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

using Edge = SolidEdge;
constexpr Edge of_tetrahedron10[] = {{0, 4}, {4, 1}, {1, 5}, {5, 2}, {2, 6}, {6, 0},
                                     {0, 7}, {7, 3}, {1, 8}, {8, 3}, {2, 9}, {9, 3}};
constexpr Edge of_hexahedron20[] = {{0, 8},  {8, 1},  {1, 9},  {9, 2},  {2, 10}, {10, 3}, {3, 11}, {11, 0},
                                    {4, 12}, {12, 5}, {5, 13}, {13, 6}, {6, 14}, {14, 7}, {7, 15}, {15, 4},
                                    {0, 16}, {16, 4}, {1, 17}, {17, 5}, {2, 18}, {18, 6}, {3, 19}, {19, 7}};
constexpr Edge of_quadrilateral[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr Edge of_triangle[] = {{0, 1}, {1, 2}, {2, 0}};
constexpr Edge of_line[] = {{0, 1}};

/// By corners of the group, of solids without nodes on edges by those of ElementGroup::hexahedron.
std::span<const Edge> edges_of(const ElementGroup& group) {
  if (group.corners() == 10) return of_tetrahedron10;
  if (group.corners() == 20) return of_hexahedron20;
  if (group.corners() == 2) return of_line;
  if (!group.segment) return edges_of_hexahedron;
  if (group.corners() == 4) return of_quadrilateral;
  return of_triangle;
}

bool is_deleted(const ElementGroup& group, Index e) {
  const Field<Index>* eroded = shared_fields::eroded.find(group.fields);
  return eroded && (*eroded)[e] != 0;
}

/// Corners of a convex face, one after the other around its middle.
template <class Point>
void sort_around(std::vector<Point>& points, const std::vector<Vec>& at) {
  Vec middle = Vec::Zero(), normal = Vec::Zero();
  for (const Vec& x : at) middle += x / static_cast<Real>(at.size());
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = i + 1; j < at.size(); ++j)
      if (const Vec n = (at[i] - middle).cross(at[j] - middle); n.norm() > normal.norm()) normal = n;
  const Vec first = at.front() - middle, second = normal.cross(first);
  std::vector<std::pair<Real, Point>> order;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Vec r = at[i] - middle;
    order.emplace_back(std::atan2(r.dot(second) * first.norm(), r.dot(first) * second.norm()), points[i]);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& p, const auto& q) { return p.first < q.first; });
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = order[i].second;
}

}  // namespace

bool CuttingPlane::contains(const Vec& point, Real tolerance) const {
  const Vec r = point - origin;
  if (radius > 0) return (r - r.dot(normal) * normal).norm() <= radius + tolerance;
  const auto within = [tolerance](Real at, Real length) {
    return length == 0 || (at >= -tolerance && at <= length + tolerance);
  };
  return within(r.dot(edge), length_l) && within(r.dot(normal.cross(edge)), length_m);
}

std::vector<ReportedElement> CrossSection::elements() const {
  std::vector<ReportedElement> out;
  for (const Cut& cut : cuts_) out.push_back(cut.element);
  return out;
}

Vec CrossSection::CutPoint::at(const World& world) const {
  return world.nodes.x.vec(a) + share * (world.nodes.x.vec(b) - world.nodes.x.vec(a));
}

/// `counts`: of nodes; `share`: of the path from a node that counts to one that does not, where the cut is.
template <class Side, class Share>
void CrossSection::add(const ReportedElement& element, const World& world, const Side& counts,
                       const Share& share) {
  const ElementGroup& group = element.reporter->reported();
  Cut cut{.element = element};
  const int corners = group.corners();
  const auto node = [&](int c) { return group.node.data(c)[element.e]; };
  for (int c = 0; c < corners; ++c) cut.counted |= counts(node(c)) ? 1U << c : 0U;
  const std::span<const Edge> edges = edges_of(group);
  const std::array<int, 8> hexahedron = group.hexahedron();
  const auto corner = [&](int end) {
    return edges.data() == edges_of_hexahedron ? hexahedron[static_cast<std::size_t>(end)] : end;
  };
  for (const Edge& edge : edges) {
    const int c = corner(edge[0]), d = corner(edge[1]);
    if (((cut.counted >> c) & 1U) == ((cut.counted >> d) & 1U)) continue;
    const bool first = ((cut.counted >> c) & 1U) != 0;
    CutPoint point{first ? node(c) : node(d), first ? node(d) : node(c), 0};
    point.share = share(point.a, point.b);
    if (point.share == 0) point.b = point.a;
    if (std::find(cut.points.begin(), cut.points.end(), point) == cut.points.end())
      cut.points.push_back(point);
  }
  if (cut.points.size() > 2) {
    std::vector<Vec> at;
    for (const CutPoint& point : cut.points) at.push_back(point.at(world));
    sort_around(cut.points, at);
  }
  cuts_.push_back(std::move(cut));
}

CrossSection::CrossSection(const std::vector<ReportedElement>& elements, const CuttingPlane& plane,
                           const World& world) {
  normal = plane.normal;
  constexpr Real relative = 1e-6;  // of an element, within which its nodes are on the plane
  for (const ReportedElement& one : elements) {
    const ElementGroup& group = one.reporter->reported();
    Real least = std::numeric_limits<Real>::infinity(), most = -least;
    const Vec first = world.nodes.x.vec(group.node.data(0)[one.e]);
    Real size = 0;
    const auto height = [&](Index n) { return (world.nodes.x.vec(n) - plane.origin).dot(plane.normal); };
    for (int c = 0; c < group.corners(); ++c) {
      const Index n = group.node.data(c)[one.e];
      least = std::min(least, height(n)), most = std::max(most, height(n));
      size = std::max(size, (world.nodes.x.vec(n) - first).norm());
    }
    const Real tolerance = relative * size;
    if (!(least <= tolerance && most > tolerance)) continue;
    add(
        one, world, [&](Index n) { return height(n) <= tolerance; },
        [&](Index a, Index b) { return std::clamp<Real>((0 - height(a)) / (height(b) - height(a)), 0, 1); });
    const auto& points = cuts_.back().points;
    if (!std::all_of(points.begin(), points.end(),
                     [&](const CutPoint& point) { return plane.contains(point.at(world), tolerance); }))
      cuts_.pop_back();
  }
}

CrossSection::CrossSection(const std::vector<ReportedElement>& elements, const std::vector<Index>& nodes,
                           const World& world) {
  const auto counts = [&](Index n) { return std::binary_search(nodes.begin(), nodes.end(), n); };
  for (const ReportedElement& one : elements) {
    add(one, world, counts, [](Index, Index) { return Real(0); });
    if (cuts_.back().counted == 0) cuts_.pop_back();
  }
}

/// Area and first moment of the cut through an element.
void CrossSection::add_measure(const Cut& cut, const World& world, SectionForce& sum) const {
  const Real measure = cut.element.reporter->cut_measure(cut.element.e);
  std::vector<Vec> at;
  for (const CutPoint& point : cut.points) at.push_back(point.at(world));
  const auto add_piece = [&sum](Real area, const Vec& middle) {
    sum.area += area;
    sum.centroid += area * middle;
  };
  switch (cut.element.kind) {
    case ElementKind::beam:
      if (!at.empty()) add_piece(measure, at[0]);
      break;
    case ElementKind::shell:
      if (at.size() == 2) add_piece((at[1] - at[0]).norm() * measure, (at[0] + at[1]) / 2);
      break;
    case ElementKind::solid: {
      Vec normal = Vec::Zero();
      for (std::size_t k = 2; k < at.size(); ++k) normal += (at[k - 1] - at[0]).cross(at[k] - at[0]);
      if (!(normal.norm() > 0)) break;
      for (std::size_t k = 2; k < at.size(); ++k)
        add_piece(0.5 * (at[k - 1] - at[0]).cross(at[k] - at[0]).dot(normal.normalized()),
                  (at[0] + at[k - 1] + at[k]) / 3);
      break;
    }
  }
}

SectionForce CrossSection::force(const World& world) const {
  SectionForce out;
  Vec middle = Vec::Zero(), about_origin = Vec::Zero();  // of nodes, where there is no area
  Real nodes = 0;
  for (const Cut& cut : cuts_) {
    const ElementGroup& group = cut.element.reporter->reported();
    const Index e = cut.element.e;
    if (is_deleted(group, e)) continue;
    add_measure(cut, world, out);
    for (int c = 0; c < group.corners(); ++c) {
      if (((cut.counted >> c) & 1U) == 0) continue;
      const auto at_corner = [&](const Field<Real>& field) {
        return Vec(field.data(3 * c)[e], field.data(3 * c + 1)[e], field.data(3 * c + 2)[e]);
      };
      const Vec x = world.nodes.x.vec(group.node.data(c)[e]), f = at_corner(*group.corner_force);
      out.force += f;
      about_origin += x.cross(f);
      if (group.corner_moment) about_origin += at_corner(*group.corner_moment);
      middle += x, nodes += 1;
    }
  }
  if (out.area > 0)
    out.centroid /= out.area;
  else if (nodes > 0)
    out.centroid = middle / nodes;
  out.moment = axes.transpose() * (about_origin - out.centroid.cross(out.force));
  out.force = axes.transpose() * out.force;
  return out;
}

}  // namespace courant
