#include "state/block_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace courant {
namespace {

/// n x n squares, row by row.
Field<Index> corners_of_squares(Index n) {
  Field<Index> node({.name = "node", .dimension = "-", .components = 4});
  node.resize(n * n);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index e = i + n * j, first = i + (n + 1) * j, of[4] = {0, 1, n + 2, n + 1};
      for (int c = 0; c < 4; ++c) node.data(c)[e] = first + of[c];
    }
  return node;
}

// What nodes get of all positions is what they get of all corners, block by block, and nothing of a step
// before.
TEST(BlockSums, NodesGetWhatTheirCornersHave) {
  constexpr Index n = 13, count = n * n;
  const Field<Index> node = corners_of_squares(n);
  BlockSums sums(node, count, "squares");
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> number(-1, 1);
  std::vector<Vec> expected;
  for (int step = 0; step < 2; ++step) {
    expected.assign((n + 1) * (n + 1), Vec::Zero());
    for (Index begin = 0; begin < count; begin += block_size) {
      Real of_corners[12][block_size];
      for (auto& component : of_corners)
        for (Real& f : component) f = number(random);
      const Index in_block = std::min(block_size, count - begin);
      for (Index i = 0; i < in_block; ++i)
        for (int c = 0; c < 4; ++c)
          for (int k = 0; k < 3; ++k)
            expected[static_cast<std::size_t>(node.data(c)[begin + i])][k] += of_corners[3 * c + k][i];
      sums.set(sums.force, begin, in_block, of_corners);
    }
  }
  std::vector<Vec> found(expected.size(), Vec::Zero());
  for (std::size_t p = 0; p < sums.nodes().size(); ++p)
    found[static_cast<std::size_t>(sums.nodes()[p])] += sums.force.vec(static_cast<Index>(p));
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR((found[k] - expected[k]).norm(), 0, 1e-14) << k;
}

// A block has a position for each of its nodes, once.
TEST(BlockSums, PlacesAreTheNodesOfEachBlock) {
  const Field<Index> node = corners_of_squares(8);
  EXPECT_EQ(BlockSums(node, 64, "squares").nodes().size(), 81u);
  const Field<Index> rows = corners_of_squares(64);
  EXPECT_EQ(BlockSums(rows, 64 * 64, "rows").nodes().size(), 64u * 2 * 65);
}

}  // namespace
}  // namespace courant
