#include "contact/edges/edge.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

namespace {

NearestPoints at_points(const EdgeEnds& a, const EdgeEnds& b, Real s, Real t) {
  NearestPoints p;
  p.s = s, p.t = t;
  p.w = a[0] - b[0] + s * (a[1] - a[0]) - t * (b[1] - b[0]);
  p.distance = p.w.norm();
  p.cross = (a[1] - a[0]).normalized().cross((b[1] - b[0]).normalized());
  p.inside = s > 0 && s < 1 && t > 0 && t < 1;
  return p;
}

/// Six times the volume of the tetrahedron of the ends: 0 where lines meet, or are parallel.
Real volume_of(const EdgeEnds& a, const EdgeEnds& b) {
  return (a[0] - b[0]).dot((a[1] - a[0]).cross(b[1] - b[0]));
}

}  // namespace

std::array<Real, 2> beside(const EdgeEnds& a, const EdgeEnds& b) {
  const Vec d = a[1] - a[0];
  const Real d2 = d.squaredNorm(), s0 = (b[0] - a[0]).dot(d) / d2, s1 = (b[1] - a[0]).dot(d) / d2;
  return {std::max(std::min(s0, s1), Real(0)), std::min(std::max(s0, s1), Real(1))};
}

NearestPoints nearest_to_point(const EdgeEnds& a, const EdgeEnds& b, Real s) {
  const Vec x = a[0] + s * (a[1] - a[0]), d = b[1] - b[0];
  return at_points(a, b, s, std::clamp((x - b[0]).dot(d) / d.squaredNorm(), Real(0), Real(1)));
}

// The lines' own nearest points where these are within both edges; else s is moved into [0, 1], t to what is
// nearest to that, and where t is moved, s once more (Ericson, Real-Time Collision Detection, 2005, 5.1.9).
NearestPoints nearest_points(const EdgeEnds& a, const EdgeEnds& b) {
  constexpr Real parallel = 1e-8;  // square of a sine
  const Vec da = a[1] - a[0], db = b[1] - b[0], r = a[0] - b[0];
  const Real aa = da.squaredNorm(), bb = db.squaredNorm(), ab = da.dot(db), ar = da.dot(r), br = db.dot(r);
  const Real det = aa * bb - ab * ab;
  Real s = 0;
  if (det > parallel * aa * bb) {
    s = std::clamp((ab * br - ar * bb) / det, Real(0), Real(1));
  } else {
    const auto [from, to] = beside(a, b);
    s = std::clamp(0.5 * (from + to), Real(0), Real(1));
  }
  Real t = (ab * s + br) / bb;
  if (t < 0 || t > 1) {
    t = std::clamp(t, Real(0), Real(1));
    s = std::clamp((ab * t - ar) / aa, Real(0), Real(1));
  }
  return at_points(a, b, s, t);
}

// The volume of the ends, of third order in time, changes its sign: where it is 0 the lines meet, and the
// edges, too, if that is within both.
bool went_through(const EdgeEnds& a0, const EdgeEnds& b0, const EdgeEnds& a1, const EdgeEnds& b1) {
  const Real before = volume_of(a0, b0), after = volume_of(a1, b1);
  if (!(before * after < 0)) return false;
  const auto at = [](const EdgeEnds& from, const EdgeEnds& to, Real u) {
    return EdgeEnds{from[0] + u * (to[0] - from[0]), from[1] + u * (to[1] - from[1])};
  };
  Real low = 0, high = 1;
  constexpr int halvings = 40;
  for (int k = 0; k < halvings; ++k) {
    const Real middle = 0.5 * (low + high);
    (before * volume_of(at(a0, a1, middle), at(b0, b1, middle)) > 0 ? low : high) = middle;
  }
  const EdgeEnds a = at(a0, a1, low), b = at(b0, b1, low);
  const NearestPoints p = nearest_points(a, b);
  constexpr Real meet = 1e-6;
  return p.distance < meet * std::min((a[1] - a[0]).norm(), (b[1] - b[0]).norm());
}

}  // namespace courant
