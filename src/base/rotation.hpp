#pragma once
#include <Eigen/Geometry>

#include "base/real.hpp"

namespace courant {

/// An orientation turned by a rotation vector, global axes. [-]
inline Eigen::Quaterniond turned_by(const Vec& angle, const Eigen::Quaterniond& q) {
  const Real a = angle.norm();
  if (a == 0) return q;
  return (Eigen::Quaterniond(Eigen::AngleAxisd(a, angle / a)) * q).normalized();
}

}  // namespace courant
