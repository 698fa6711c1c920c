#include "loads/walls/wall_shape.hpp"

#include <algorithm>
#include <limits>

namespace courant {

namespace {

/// How far s is beyond [low, high], with its sign.
Real beyond(Real s, Real low, Real high) {
  return s < low ? s - low : s > high ? s - high : Real(0);
}

}  // namespace

WallShape::Near WallShape::nearest(const Vec& x) const {
  const Vec r = x - tail;
  switch (kind) {
    case Kind::plane:
      return {r.dot(n()), n()};
    case Kind::prism:
      return nearest_of_prism(r);
    case Kind::cylinder:
      return nearest_of_cylinder(r);
    case Kind::sphere: {
      const Real d = r.norm();
      return {d - radius, d > 0 ? Vec(r / d) : n()};
    }
  }
  return {};
}

WallShape::Near WallShape::nearest_of_prism(const Vec& r) const {
  constexpr Real far = std::numeric_limits<Real>::infinity();
  const Vec s = axes.transpose() * r;
  Vec out;
  Near inside{-far, n()};
  for (int k = 0; k < 3; ++k) {
    const Real end = length[static_cast<std::size_t>(k)];
    const Real low = k == 2 ? (end > 0 ? -end : -far) : (end > 0 ? 0 : -far);
    const Real high = k == 2 ? 0 : (end > 0 ? end : far);
    out[k] = beyond(s[k], low, high);
    if (s[k] - high > inside.gap) inside = {s[k] - high, axes.col(k)};
    if (low - s[k] > inside.gap) inside = {low - s[k], Vec(-axes.col(k))};
  }
  const Real gap = out.norm();
  return gap > 0 ? Near{gap, Vec(axes * out / gap)} : inside;
}

WallShape::Near WallShape::nearest_of_cylinder(const Vec& r) const {
  const Real along = r.dot(n()), end = length[2];
  const Vec across = r - along * n();
  const Real d = across.norm();
  const Vec radial = d > 0 ? Vec(across / d) : Vec(axes.col(0));
  const Real past = end > 0 ? beyond(along, 0, end) : 0;
  const Vec out = std::max(d - radius, Real(0)) * radial + past * n();
  const Real gap = out.norm();
  if (gap > 0) return {gap, Vec(out / gap)};
  Near inside{d - radius, radial};
  if (end > 0 && along - end > inside.gap) inside = {along - end, n()};
  if (end > 0 && -along > inside.gap) inside = {-along, Vec(-n())};
  return inside;
}

bool WallShape::meets(const Vec& next, Real gap) const {
  if (kind != Kind::plane) return nearest(next).gap < 0;
  if (!has_edges()) return true;
  constexpr Real behind = 1e-6;  // what came there beside the wall
  if (gap < -behind * std::max(length[0], length[1])) return false;
  const auto within = [](Real s, Real end) { return end == 0 || (s >= 0 && s <= end); };
  const Vec r = next - tail;
  return within(r.dot(axes.col(0)), length[0]) && within(r.dot(axes.col(1)), length[1]);
}

}  // namespace courant
