#include "parallel/counting_sort.hpp"

#include <algorithm>

#include "parallel/parallel.hpp"

namespace courant {

// Each thread sorts keys of its own and passes over those of others: tables of keys are larger than what is
// sorted, and what is sorted is nearly in order already, so that the test is well predicted.
void counting_sort(std::span<const Index> key, Index keys, std::vector<Index>& start,
                   std::vector<Index>& order) {
  const Index n = static_cast<Index>(key.size());
  constexpr Index worth_threads = 2000;
  const int shares = std::max(n, keys) < worth_threads ? 1 : threads();
  start.resize(keys + 1);
  order.resize(n);
  std::vector<Index> total(shares + 1, 0);
  const auto first = [&](int t) { return static_cast<Index>(std::int64_t{keys} * t / shares); };
  on_threads(shares, [&](int t) {
    const Index low = first(t), high = first(t + 1);
    Index* count = start.data();
    std::fill(count + low, count + high, 0);
    Index mine = 0;
    for (const Index k : key)
      if (k >= low && k < high) ++count[k], ++mine;
    total[t + 1] = mine;
  });
  for (int t = 0; t < shares; ++t) total[t + 1] += total[t];
  start[keys] = n;
  on_threads(shares, [&](int t) {
    const Index low = first(t), high = first(t + 1);
    Index* end = start.data();  // of those with key k, until all of them are before it
    Index sum = total[t];
    for (Index k = low; k < high; ++k) {
      sum += end[k];
      end[k] = sum;
    }
    for (Index i = n - 1; i >= 0; --i) {
      const Index k = key[i];
      if (k >= low && k < high) order[--end[k]] = i;
    }
  });
}

}  // namespace courant
