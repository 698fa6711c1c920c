#include "sph/inlets/inlet_shape.hpp"

#include <algorithm>
#include <cmath>

#include "search/nearest_distance.hpp"

namespace courant {

namespace {

std::vector<Real> nearest(const std::vector<Vec>& points) {
  std::vector<Real> x, y, z;
  for (const Vec& p : points) x.push_back(p[0]), y.push_back(p[1]), z.push_back(p[2]);
  return nearest_distance(x.data(), y.data(), z.data(), static_cast<Index>(points.size()));
}

/// How many cells of about `size` a length has.
int cells(Real length, Real size) {
  return std::max(1, static_cast<int>(std::lround(length / size)));
}

}  // namespace

std::optional<Real> lattice_side(const std::vector<Vec>& points, const Vec& normal, int dim) {
  if (points.size() < 2) return {};
  // Of the side, for neighbours, and for positions, where what the side errs adds up. A hexagonal lattice is
  // off by 0.13.
  constexpr Real tolerance = 0.01, place_tolerance = 0.1;
  const std::vector<Real> distances = nearest(points);
  const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
  const Real side = *least;
  if (!(side > 0) || *most > (1 + tolerance) * side) return {};
  const Vec e1 = [&] {  // from the first point to the nearest
    std::size_t to = 1;
    for (std::size_t k = 2; k < points.size(); ++k)
      if ((points[k] - points[0]).squaredNorm() < (points[to] - points[0]).squaredNorm()) to = k;
    return Vec((points[to] - points[0]).normalized());
  }();
  const Vec e2 = normal.cross(e1);
  const auto off = [](Real u) { return std::abs(u - std::round(u)) > place_tolerance; };
  for (const Vec& p : points) {
    const Real u = (p - points[0]).dot(e1) / side, v = (p - points[0]).dot(e2) / side;
    if (off(u) || (dim == 2 ? std::abs(v) > place_tolerance : off(v))) return {};
  }
  return side;
}

InletShape rectangle(const Vec& centre, const Vec& e1, const Vec& e2, Real length1, Real length2, Real size,
                     int dim) {
  const int n1 = cells(length1, size), n2 = dim == 2 ? 1 : cells(length2, size);
  const Real s1 = length1 / n1, s2 = length2 / n2;
  InletShape out{.places = {}, .area = dim == 2 ? s1 : s1 * s2, .spacing = s1};
  for (int j = 0; j < n2; ++j)
    for (int i = 0; i < n1; ++i) {
      const Vec across = dim == 2 ? Vec(Vec::Zero()) : Vec((j + 0.5 - 0.5 * n2) * s2 * e2);
      out.places.push_back(centre + (i + 0.5 - 0.5 * n1) * s1 * e1 + across);
    }
  return out;
}

InletShape circle(const Vec& centre, const Vec& e1, const Vec& e2, Real radius, Real size, int dim) {
  if (dim == 2) return rectangle(centre, e1, e2, 2 * radius, 0, size, dim);
  const int n = static_cast<int>(std::ceil(radius / size));
  std::vector<std::pair<int, int>> inside;
  for (int j = -n; j <= n; ++j)
    for (int i = -n; i <= n; ++i)
      if (i * i + j * j <= (radius / size) * (radius / size)) inside.emplace_back(i, j);
  InletShape out;
  out.area = pi * radius * radius / static_cast<Real>(inside.size());
  out.spacing = std::sqrt(out.area);
  for (const auto& [i, j] : inside) out.places.push_back(centre + out.spacing * (i * e1 + j * e2));
  return out;
}

}  // namespace courant
