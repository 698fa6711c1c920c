#pragma once
#include <optional>

#include <Eigen/Geometry>

#include "base/real.hpp"

namespace courant {

/// An orientation turned by a rotation vector, global axes. [-]
inline Eigen::Quaterniond turned_by(const Vec& angle, const Eigen::Quaterniond& q) {
  const Real a = angle.norm();
  if (a == 0) return q;
  return (Eigen::Quaterniond(Eigen::AngleAxisd(a, angle / a)) * q).normalized();
}

/// The matrix of a x, the cross product with a.
inline Matrix skew(const Vec& a) {
  Matrix out;
  out << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return out;
}

/// Axes of a right-handed system from its x axis and a vector in its xy plane; nothing if they span no plane.
inline std::optional<Matrix> axes_from(const Vec& x, const Vec& xy) {
  constexpr Real parallel = 1e-8;  // sine of the angle between the two
  const Vec z = x.cross(xy);
  if (!(z.norm() > parallel * x.norm() * xy.norm())) return std::nullopt;
  Matrix axes;
  axes.col(0) = x.normalized();
  axes.col(2) = z.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

}  // namespace courant
