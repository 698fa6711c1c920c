// Inertia of bodies of constant density against closed forms.
#include "rigid/bodies/inertia.hpp"

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

// A brick of edges a, b, c: m/12 of sums of squares. A tetrahedron and a wedge: sums of second moments over
// simplices, V/20 (sum of x x^T + S S^T), S the sum of its corners.
TEST(Inertia, OfSolidsIsExact) {
  const Hexahedron still{};
  const auto simplex = [](const std::array<Vec, 4>& x, MassIntegrals& sums) {
    const Real V = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
    Vec S = Vec::Zero();
    Matrix xx = Matrix::Zero();
    for (const Vec& corner : x) S += corner, xx += corner * corner.transpose();
    sums.m += V, sums.x += V / 4 * S, sums.xx += V / 20 * (xx + S * S.transpose());
  };
  const auto q = Eigen::Quaterniond(1, 2, -3, 0.5).normalized();
  const Vec edges(1, 2, 3), c(4, -1, 2);
  Hexahedron brick;
  for (std::size_t k = 0; k < 8; ++k)
    brick[k] = c + q * Vec(k % 4 == 1 || k % 4 == 2 ? 1 : 0, k % 4 >= 2 ? 2 : 0, k >= 4 ? 3 : 0);
  MassIntegrals sums{.origin = Vec(1, 1, 1)};
  add_solid(brick, still, sums);
  const Vec second = edges.cwiseProduct(edges) / 2;
  const Matrix turn = q.toRotationMatrix();
  const Matrix exact = turn * (second.sum() * Vec::Ones() - second).asDiagonal() * turn.transpose();
  EXPECT_NEAR(sums.m, 6, 1e-13);
  EXPECT_NEAR((sums.centre() - c - q * Vec(0.5 * edges)).norm(), 0, 1e-13);
  EXPECT_NEAR((sums.inertia() - exact).norm(), 0, 1e-12);

  const Vec a(0, 0, 0), b(1, 0.2, 0), d(0.3, 1, 0.1), e(0.1, 0.2, 1.5), shift(0.2, -0.1, 2);
  MassIntegrals tetrahedron, of_simplex;
  add_solid({a, b, d, d, e, e, e, e}, still, tetrahedron);
  simplex({a, b, d, e}, of_simplex);
  EXPECT_NEAR(tetrahedron.m, of_simplex.m, 1e-15);
  EXPECT_NEAR((tetrahedron.centre() - of_simplex.centre()).norm(), 0, 1e-14);
  EXPECT_NEAR((tetrahedron.inertia() - of_simplex.inertia()).norm(), 0, 1e-14);
  MassIntegrals wedge, of_three;
  add_solid({a, b, d, d, a + shift, b + shift, d + shift, d + shift}, still, wedge);
  simplex({a, b, d, a + shift}, of_three);
  simplex({b, d, a + shift, b + shift}, of_three);
  simplex({d, a + shift, b + shift, d + shift}, of_three);
  EXPECT_NEAR(wedge.m, of_three.m, 1e-14);
  EXPECT_NEAR((wedge.inertia() - of_three.inertia()).norm(), 0, 1e-13);
}

// v = v0 + omega x (x - c): momentum m v(centre), angular momentum J omega.
TEST(Inertia, OfATurningSolidGivesItsMomenta) {
  const Vec omega(0.3, -0.7, 1.1), v0(1, 2, 3);
  Hexahedron x, v;
  for (std::size_t k = 0; k < 8; ++k) {
    x[k] = Vec(k % 4 == 1 || k % 4 == 2 ? 1 : 0, k % 4 >= 2 ? 2 : 0, k >= 4 ? 3 : 0);
    v[k] = v0 + omega.cross(x[k]);
  }
  MassIntegrals sums{.origin = Vec(-1, 0, 2)};
  add_solid(x, v, sums);
  EXPECT_NEAR((sums.momentum - sums.m * (v0 + omega.cross(sums.centre()))).norm(), 0, 1e-12);
  EXPECT_NEAR((sums.angular_momentum() - sums.inertia() * omega).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace courant
