#include "rigid/bodies/inertia.hpp"

#include <cmath>

namespace courant {

void MassIntegrals::add_point(Real mass, const Vec& place, const Vec& velocity) {
  const Vec from = place - origin;
  m += mass;
  x += mass * from;
  xx += mass * from * from.transpose();
  momentum += mass * velocity;
  about_origin += mass * from.cross(velocity);
}

MassIntegrals& MassIntegrals::operator*=(Real factor) {
  m *= factor, x *= factor, xx *= factor, momentum *= factor, about_origin *= factor;
  return *this;
}

MassIntegrals& MassIntegrals::operator+=(const MassIntegrals& other) {
  m += other.m, x += other.x, xx += other.xx, momentum += other.momentum, about_origin += other.about_origin;
  return *this;
}

Matrix MassIntegrals::inertia() const {
  const Matrix second = xx - x * x.transpose() / m;
  return second.trace() * Matrix::Identity() - second;
}

void add_shell(const Quadrilateral& x, const Quadrilateral& v, Real t, MassIntegrals& sums) {
  const Real far = std::sqrt(Real(0.6));
  constexpr Real outer = 5.0 / 9, inner = 8.0 / 9;
  const std::array<std::array<Real, 2>, 3> points{{{-far, outer}, {0, inner}, {far, outer}}};
  for (const auto& at_r : points)
    for (const auto& at_s : points) {
      const Real r = at_r[0], s = at_s[0];
      const std::array<Real, 4> N{(1 - r) * (1 - s) / 4, (1 + r) * (1 - s) / 4, (1 + r) * (1 + s) / 4,
                                  (1 - r) * (1 + s) / 4};
      const auto slope_r = [&](const Quadrilateral& q) -> Vec {
        return ((1 - s) * (q[1] - q[0]) + (1 + s) * (q[2] - q[3])) / 4;
      };
      const auto slope_s = [&](const Quadrilateral& q) -> Vec {
        return ((1 - r) * (q[3] - q[0]) + (1 + r) * (q[2] - q[1])) / 4;
      };
      const Vec along_r = slope_r(x), along_s = slope_s(x), velocity_r = slope_r(v), velocity_s = slope_s(v);
      const Vec normal = along_r.cross(along_s);
      const Real area = normal.norm(), mass = at_r[1] * at_s[1] * area;
      if (!(mass > 0)) continue;
      Vec place = Vec::Zero(), velocity = Vec::Zero();
      for (std::size_t e = 0; e < 4; ++e) place += N[e] * x[e], velocity += N[e] * v[e];
      sums.add_point(mass, place, velocity);
      const Vec n = normal / area;
      const Vec turning = (velocity_r.cross(along_s) + along_r.cross(velocity_s)) / area;
      sums.xx += mass * t * t / 12 * n * n.transpose();
      sums.about_origin += mass * t * t / 12 * n.cross(turning);  // what the normal's turning carries
    }
}

void add_solid(const Hexahedron& x, const Hexahedron& v, MassIntegrals& sums) {
  const std::array<Real, 3> at{-std::sqrt(Real(0.6)), 0, std::sqrt(Real(0.6))};
  constexpr std::array<Real, 3> weight{5.0 / 9, 8.0 / 9, 5.0 / 9};
  for (std::size_t i = 0; i < 27; ++i) {
    const std::array<std::size_t, 3> k{i % 3, i / 3 % 3, i / 9};
    Matrix jacobian = Matrix::Zero();
    Vec place = Vec::Zero(), velocity = Vec::Zero();
    for (std::size_t c = 0; c < 8; ++c) {
      const Vec sign(c % 4 == 1 || c % 4 == 2 ? 1 : -1, c % 4 >= 2 ? 1 : -1, c >= 4 ? 1 : -1);
      const Vec f(1 + sign[0] * at[k[0]], 1 + sign[1] * at[k[1]], 1 + sign[2] * at[k[2]]);
      place += f.prod() / 8 * x[c], velocity += f.prod() / 8 * v[c];
      jacobian +=
          x[c] * Vec(sign[0] * f[1] * f[2], f[0] * sign[1] * f[2], f[0] * f[1] * sign[2]).transpose() / 8;
    }
    sums.add_point(weight[k[0]] * weight[k[1]] * weight[k[2]] * jacobian.determinant(), place, velocity);
  }
}

}  // namespace courant
