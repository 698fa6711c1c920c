// Where particles of a layer stand, and the area that each has.
#include "sph/inlets/inlet_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace courant {
namespace {

std::vector<Vec> lattice(int n1, int n2, Real side, Real second_row = 0) {
  std::vector<Vec> out;
  for (int j = 0; j < n2; ++j)
    for (int i = 0; i < n1; ++i) out.emplace_back(0.3, side * (i + (j % 2) * second_row), side * j);
  return out;
}

TEST(LatticeSide, IsThatOfSquaresOnAnyTurnedLatticeWithHoles) {
  const Matrix turn = Eigen::AngleAxisd(0.7, Vec(1, 2, 2) / 3).toRotationMatrix();
  std::vector<Vec> points;
  for (const Vec& p : lattice(7, 5, 0.02))
    if ((p - Vec(0.3, 0.06, 0.04)).norm() > 0.021) points.push_back(turn * p + Vec(5, 6, 7));
  const auto side = lattice_side(points, turn * Vec::UnitX(), 3);
  ASSERT_TRUE(side.has_value());
  EXPECT_NEAR(*side, 0.02, 1e-13);
}

TEST(LatticeSide, IsUnknownOfOtherPoints) {
  const Vec x = Vec::UnitX();
  EXPECT_FALSE(lattice_side({Vec(0, 0, 0)}, x, 3).has_value());
  EXPECT_FALSE(lattice_side({Vec(0, 0, 0), Vec(0, 0, 0)}, x, 3).has_value()) << "two in one place";
  EXPECT_FALSE(lattice_side(lattice(5, 5, 0.02, 0.5), x, 3).has_value()) << "every second row shifted";
  std::vector<Vec> hexagonal;
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i) hexagonal.emplace_back(0, i + 0.5 * (j % 2), j * std::sqrt(0.75));
  EXPECT_FALSE(lattice_side(hexagonal, x, 3).has_value());
  std::vector<Vec> gap = lattice(5, 1, 0.02);
  gap.emplace_back(0.3, 0.2, 0);
  EXPECT_FALSE(lattice_side(gap, x, 2).has_value()) << "one stands alone";
  EXPECT_FALSE(lattice_side(lattice(3, 3, 0.02), x, 2).has_value()) << "in 2D only a line has an area";
  EXPECT_TRUE(lattice_side(lattice(3, 1, 0.02), x, 2).has_value());
}

TEST(Rectangle, IsCutIntoEqualCells) {
  const InletShape s = rectangle(Vec(1, 2, 3), Vec::UnitY(), Vec::UnitZ(), 0.9, 0.41, 0.1, 3);
  ASSERT_EQ(s.places.size(), 36u);
  EXPECT_NEAR(s.area * 36, 0.9 * 0.41, 1e-14);
  Vec mean = Vec::Zero(), most = Vec::Zero();
  for (const Vec& p : s.places) {
    mean += p / 36;
    most = most.cwiseMax((p - Vec(1, 2, 3)).cwiseAbs());
  }
  EXPECT_NEAR((mean - Vec(1, 2, 3)).norm(), 0, 1e-14);
  EXPECT_NEAR((most - Vec(0, 0.4, 0.41 * 1.5 / 4)).norm(), 0, 1e-14);
  const InletShape line = rectangle(Vec::Zero(), Vec::UnitY(), Vec::Zero(), 0.9, 0, 0.2, 2);
  EXPECT_EQ(line.places.size(), 5u);  // 4.5 is rounded away from zero
  EXPECT_NEAR(line.area * 5, 0.9, 1e-15);
}

TEST(Circle, HasItsAreaAndNobodyOutside) {
  for (const Real size : {0.3, 0.1, 0.031}) {
    const InletShape s = circle(Vec(1, 2, 3), Vec::UnitY(), Vec::UnitZ(), 0.5, size, 3);
    EXPECT_NEAR(s.area * static_cast<Real>(s.places.size()), pi * 0.25, 1e-13);
    EXPECT_NEAR(s.spacing, size, 0.15 * size);
    for (const Vec& p : s.places) EXPECT_LE((p - Vec(1, 2, 3)).norm(), 0.5 + 0.15 * size);
    for (std::size_t a = 1; a < s.places.size(); ++a)
      EXPECT_GE((s.places[a] - s.places[0]).norm(), s.spacing * (1 - 1e-12));
  }
}

}  // namespace
}  // namespace courant
