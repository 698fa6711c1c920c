// Inertia of bodies of constant density against closed forms.
#include "rigid/inertia.hpp"

#include <gtest/gtest.h>

namespace courant {
namespace {

const Quadrilateral no_motion{Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero()};

/// The six faces of a box about c, turned by q: one shell each, t thick, of unit mass per area.
MassIntegrals box_of_shells(const Vec& half, const Vec& c, const Eigen::Quaterniond& q, Real t) {
  MassIntegrals out{.origin = Vec(3, -2, 1)};
  for (int k = 0; k < 3; ++k)
    for (const Real side : {-1, 1}) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      Quadrilateral x;
      for (std::size_t e = 0; e < 4; ++e) {
        Vec corner;
        corner[k] = side * half[k];
        corner[i] = (e == 1 || e == 2 ? 1 : -1) * half[i];
        corner[j] = (e >= 2 ? 1 : -1) * half[j];
        x[e] = c + q * corner;
      }
      add_shell(x, no_motion, t, out);
    }
  return out;
}

// Two faces of area 4 h_i h_j at distance h_k: m (h_k^2 + h_i^2/3 ...) about each axis. Masses at the corners
// would have 1.8 times that of a cube.
TEST(Inertia, OfABoxOfSixShellsIsExact) {
  const Vec half(0.5, 1, 1.5), c(4, -1, 2);
  const auto q = Eigen::Quaterniond(1, 2, -3, 0.5).normalized();
  const MassIntegrals sums = box_of_shells(half, c, q, 0);
  Vec second = Vec::Zero();  // of x_k^2 dm
  Real m = 0;
  for (int k = 0; k < 3; ++k) {
    const Real faces = 8 * half[(k + 1) % 3] * half[(k + 2) % 3];
    m += faces;
    for (int a = 0; a < 3; ++a) second[a] += faces * half[a] * half[a] * (a == k ? 1 : 1.0 / 3);
  }
  const Matrix turn = q.toRotationMatrix();
  const Matrix exact = turn * (second.sum() * Vec::Ones() - second).asDiagonal() * turn.transpose();
  EXPECT_NEAR(sums.m, m, 1e-13 * m);
  EXPECT_NEAR((sums.centre() - c).norm(), 0, 1e-13);
  EXPECT_NEAR((sums.inertia() - exact).norm(), 0, 1e-13 * exact.norm());
  const MassIntegrals cube = box_of_shells(Vec::Ones(), c, q, 0);
  MassIntegrals corners{.origin = c};
  for (int k = 0; k < 8; ++k)
    corners.add_point(cube.m / 8, c + Vec(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1), Vec::Zero());
  EXPECT_NEAR(corners.inertia().trace() / cube.inertia().trace(), 1.8, 1e-12);
}

// A solid plate of edges a, b, t: m/12 of sums of squares. A triangle of height h over its base: m h^2/18.
TEST(Inertia, OfAThickPlateAndOfATriangleIsExact) {
  MassIntegrals plate{};
  add_shell({Vec(0, 0, 0), Vec(3, 0, 0), Vec(3, 2, 0), Vec(0, 2, 0)}, no_motion, 0.5, plate);
  const Vec exact = plate.m / 12 * Vec(4 + 0.25, 9 + 0.25, 9 + 4);
  EXPECT_NEAR((plate.inertia() - Matrix(exact.asDiagonal())).norm(), 0, 1e-13);
  MassIntegrals triangle{};
  add_shell({Vec(0, 0, 0), Vec(3, 0, 0), Vec(1, 2, 0), Vec(1, 2, 0)}, no_motion, 0, triangle);
  EXPECT_NEAR(triangle.m, 3, 1e-14);
  EXPECT_NEAR((triangle.centre() - Vec(4.0 / 3, 2.0 / 3, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR(triangle.inertia()(0, 0), 3 * 4 / 18.0, 1e-13);
}

// v = V + omega x (x - c) of all points gives momentum m V and angular momentum J omega.
TEST(Inertia, AngularMomentumIsInertiaTimesTurning) {
  const Quadrilateral x{Vec(0, 0, 0), Vec(3, 0, 1), Vec(4, 2, 1.2), Vec(0, 2, 0.1)};
  MassIntegrals still{};
  add_shell(x, no_motion, 0.7, still);
  const Vec V(1, 2, 3), omega(0.3, -0.2, 0.5);
  Quadrilateral v;
  for (std::size_t e = 0; e < 4; ++e) v[e] = V + omega.cross(x[e] - still.centre());
  MassIntegrals sums{};
  add_shell(x, v, 0.7, sums);
  EXPECT_NEAR((sums.momentum - sums.m * V).norm(), 0, 1e-12);
  EXPECT_NEAR((sums.angular_momentum() - still.inertia() * omega).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace courant
