#include "search/nearest_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace courant;

namespace {

struct Places {
  std::vector<Real> x, y, z;
  void add(Real a, Real b, Real c) { x.push_back(a), y.push_back(b), z.push_back(c); }
  Index size() const { return static_cast<Index>(x.size()); }
  std::vector<Real> nearest() const { return nearest_distance(x.data(), y.data(), z.data(), size()); }
};

Real by_trying_all(const Places& p, Index i) {
  Real best2 = std::numeric_limits<Real>::infinity();
  for (Index j = 0; j < p.size(); ++j)
    if (j != i)
      best2 = std::min(best2, (Vec(p.x[i], p.y[i], p.z[i]) - Vec(p.x[j], p.y[j], p.z[j])).squaredNorm());
  return std::sqrt(best2);
}

}  // namespace

TEST(NearestDistance, OfALatticeIsItsSpacing) {
  Places p;
  for (int a = 0; a < 30; ++a)
    for (int b = 0; b < 20; ++b) p.add(0.5 * a, 0.5 * b, 3);
  for (const Real d : p.nearest()) EXPECT_NEAR(d, 0.5, 1e-12);
  p.add(100, 100, 3);
  EXPECT_NEAR(p.nearest().back(), std::hypot(100 - 14.5, 100 - 9.5), 1e-9);
}

TEST(NearestDistance, IsWhatTryingAllPairsFinds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> u(0, 1);
  for (const auto& side : {Vec(1, 1, 1), Vec(1, 0.01, 1), Vec(3, 0, 0), Vec(0.2, 5, 0)}) {
    Places p;
    for (int k = 0; k < 700; ++k)  // half of them crowded in one corner
      p.add(side[0] * std::pow(u(random), 1 + k % 2 * 4), side[1] * u(random), side[2] * u(random) - 2);
    const std::vector<Real> nearest = p.nearest();
    for (Index i = 0; i < p.size(); ++i) EXPECT_NEAR(nearest[i], by_trying_all(p, i), 1e-15) << side;
  }
}

TEST(NearestDistance, TakesNoLongerForPointsFarOff) {
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> u(0, 1);
  Places p;
  constexpr int crowd = 200000;  // trying all pairs would take minutes
  for (int k = 0; k < crowd; ++k) p.add(u(random), u(random), u(random));
  for (int k = 0; k < 20; ++k) p.add(1e4 * u(random), -1e5 * u(random), 300 + 2e4 * u(random));
  p.add(-1e7, 1e7, 0);
  for (int k = 0; k < 40; ++k) p.add(0.25, 0.5, 0.75);
  const std::vector<Real> nearest = p.nearest();
  for (Index i = 0; i < crowd; i += 997) EXPECT_NEAR(nearest[i], by_trying_all(p, i), 1e-15);
  for (Index i = crowd; i < p.size(); ++i) EXPECT_DOUBLE_EQ(nearest[i], by_trying_all(p, i));
}

TEST(NearestDistance, OfFewPoints) {
  Places p;
  EXPECT_TRUE(p.nearest().empty());
  p.add(1, 2, 3);
  EXPECT_TRUE(std::isinf(p.nearest()[0]));
  p.add(1, 2, 3);
  EXPECT_EQ(p.nearest(), std::vector<Real>({0, 0}));
  p.add(1, 2, 5);
  EXPECT_EQ(p.nearest(), std::vector<Real>({0, 0, 2}));
}
