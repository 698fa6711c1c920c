#include "parallel/counting_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "parallel/parallel.hpp"

namespace courant {
namespace {

/// Few are sorted by one thread, many by as many as there are.
class CountingSort : public testing::TestWithParam<Index> {};
INSTANTIATE_TEST_SUITE_P(Sizes, CountingSort, testing::Values(0, 1, 70, 5000));

TEST_P(CountingSort, IsStableAndTellsWhereEachKeyStarts) {
  const Index n = GetParam(), keys = 2 * n + 3;
  std::mt19937 random(7);
  std::vector<Index> key(n);
  for (Index& k : key) k = static_cast<Index>(random() % (keys - 2)) + (random() % 5 == 0 ? 2 : 0);
  std::vector<Index> expected(n);
  std::iota(expected.begin(), expected.end(), 0);
  std::stable_sort(expected.begin(), expected.end(), [&](Index a, Index b) { return key[a] < key[b]; });
  for (const int threads : {1, 2, 3}) {
    set_threads(threads);
    std::vector<Index> start(9, 77), order(5, 77);  // what was there before does not matter
    counting_sort(key, keys, start, order);
    EXPECT_EQ(order, expected) << threads;
    ASSERT_EQ(start.size(), std::size_t(keys + 1));
    for (Index k = 0; k <= keys; ++k) {
      const Index before = std::count_if(key.begin(), key.end(), [k](Index of) { return of < k; });
      ASSERT_EQ(start[k], before) << k << " on " << threads;
    }
  }
  set_threads(0);
}

TEST(Collect, KeepsTheOrderOnAnyNumberOfThreads) {
  constexpr Index n = 11 * block_size + 5;
  std::vector<Index> expected;
  for (Index i = 0; i < n; ++i)
    if (i % 7 == 3) expected.push_back(i);
  for (const int threads : {1, 2, 3, 20}) {
    set_threads(threads);
    std::vector<Index> found{1, 2, 3};
    collect(n, found, [](Index begin, Index end, std::vector<Index>& out) {
      for (Index i = begin; i < end; ++i)
        if (i % 7 == 3) out.push_back(i);
    });
    EXPECT_EQ(found, expected) << threads;
  }
  set_threads(0);
}

}  // namespace
}  // namespace courant
