#include "model/conditions/prescribed_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace courant {

namespace {

/// Calls of(from, to, value at from, value at to) for every straight piece of a curve between a and b.
template <class F>
void for_pieces(const Curve& curve, Real a, Real b, const F& of) {
  const auto& x = curve.abscissa;
  const auto& y = curve.ordinate;
  const std::size_t n = x.size();
  const auto first = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), a) - x.begin());
  for (std::size_t k = first; k <= n; ++k) {  // piece k ends at point k
    const Real from = k == 0 ? a : std::max(a, x[k - 1]), to = k == n ? b : std::min(b, x[k]);
    if (from >= b) return;
    if (from >= to) continue;
    if (k == 0 || k == n) {  // constant beyond the ends
      const Real value = k == 0 ? y.front() : y.back();
      of(from, to, value, value);
    } else {
      const Real slope = (y[k] - y[k - 1]) / (x[k] - x[k - 1]);
      of(from, to, y[k - 1] + slope * (from - x[k - 1]), y[k - 1] + slope * (to - x[k - 1]));
    }
  }
}

}  // namespace

Real mean_of_integral(const Curve& curve, Real a, Real b) {
  if (b <= 0) return 0;
  const Real from = std::max(a, Real(0));
  Real twice = 0;  // integral of (b - s) c(s), of degree 2 in each piece: Simpson's rule is exact
  for_pieces(curve, from, b, [&](Real s0, Real s1, Real c0, Real c1) {
    twice += (s1 - s0) / 6 * ((b - s0) * c0 + (2 * b - s0 - s1) * (c0 + c1) + (b - s1) * c1);
  });
  return (integral(curve, 0, from) * (b - from) + twice) / (b - a);
}

Real integral(const Curve& curve, Real a, Real b) {
  Real sum = 0;
  for_pieces(curve, a, b, [&](Real s0, Real s1, Real c0, Real c1) { sum += (s1 - s0) * 0.5 * (c0 + c1); });
  return sum;
}

Real rise(const Curve& curve, Real a, Real b) {
  Real sum = 0;
  for_pieces(curve, a, b, [&](Real, Real, Real c0, Real c1) { sum += c1 - c0; });
  return sum;
}

Real PrescribedMotion::velocity(Real t, Real dt, Real dt_old, Real before) const {
  if (source) return source->velocity(component);
  const Real end = t + dt - birth, start = t - birth, from = std::max(start, Real(0));
  switch (kind) {
    case Kind::velocity:
      return sf * integral(curve, from, end) / (end - from);
    case Kind::displacement: {
      const bool first = !(dt_old > 0) || t - 0.5 * dt_old < birth;
      return sf * (first ? jump + rise(curve, 0, end) : rise(curve, from, end)) / dt;
    }
    case Kind::acceleration: {
      const Real last = dt_old > 0 ? mean_of_integral(curve, start - dt_old, start) : 0;
      return before + sf * (mean_of_integral(curve, start, end) - last);
    }
  }
  return before;
}

std::string clash(const PrescribedMotion& a, const PrescribedMotion& b) {
  constexpr Real right_angle = 1e-9;  // cosine
  if (a.turns != b.turns || a.death <= b.birth || b.death <= a.birth) return {};
  if (a.local != b.local)
    return "is along axes that turn with the body, or this one is: both at the same time";
  const Real cosine = std::abs(a.direction.dot(b.direction));
  if (cosine <= right_angle) return {};
  return cosine >= 1 - right_angle
             ? "drives the same direction at the same time"
             : "drives a direction at the same time that is not at right angles to this one";
}

}  // namespace courant
