// The grid over the points against the search.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "base/indexed_pieces.hpp"

using namespace courant;

namespace {

void expect_same(const std::vector<Real>& x, const std::vector<Real>& y) {
  const StraightPieces searched(x, y);
  const IndexedPieces indexed(x, y);
  std::vector<Real> arguments = x;
  for (const Real at : x) {
    arguments.push_back(std::nextafter(at, -1e30));
    arguments.push_back(std::nextafter(at, 1e30));
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<Real> within(x.front() - 1, x.back() + 1);
  for (int k = 0; k < 20000; ++k) arguments.push_back(within(random));
  for (const Real at : arguments) {
    Real slope = 0;
    EXPECT_EQ(indexed.piece(at), piece_of(x, at)) << at;
    EXPECT_EQ(indexed(at, slope), searched(at)) << at;
    EXPECT_EQ(slope, searched.slope(piece_of(x, at))) << at;
  }
}

}  // namespace

TEST(IndexedPieces, AreThoseThatASearchFinds) {
  expect_same({0, 1}, {2, 3});
  expect_same({-0.3, 0.1, 0.2}, {2, 3, -1});
  std::vector<Real> even, far, y;
  for (int k = 0; k < 200; ++k) even.push_back(0.1 * k / 3), y.push_back(k % 7);
  for (int k = 0; k < 200; ++k) far.push_back(1e-6 * std::pow(1.1, k));  // more than cells in a cache
  expect_same(even, y);
  expect_same(far, y);
}

TEST(IndexedPieces, BeyondThePointsAsAsked) {
  const std::vector<Real> x{1, 2, 4}, y{10, 20, 30};
  const IndexedPieces constant(x, y, IndexedPieces::Beyond::constant), straight(x, y);
  EXPECT_EQ(constant(0), 10);
  EXPECT_EQ(constant(1), 10);
  EXPECT_EQ(constant(1.5), 15);
  EXPECT_EQ(constant(4), 30);
  EXPECT_EQ(constant(1e300), 30);
  EXPECT_EQ(straight(0), 0);
  EXPECT_EQ(straight(6), 40);
  EXPECT_EQ(IndexedPieces({3}, {7})(100), 7);
  EXPECT_TRUE(IndexedPieces({}, {}).empty());
  EXPECT_TRUE(std::isnan(straight(std::numeric_limits<Real>::quiet_NaN())));
}
