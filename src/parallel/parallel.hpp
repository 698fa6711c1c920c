#pragma once
// The only place that names threads. Work is cut into blocks of a fixed size, so a sum has the same bits on
// any number of threads: each block is summed alone, then the blocks are added in order.
#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

#include "base/real.hpp"

namespace courant {

void set_threads(int threads);  ///< 0: as many as the machine has cores
int threads();

inline constexpr Index block_size = 64;
inline Index block_count(Index n) {
  return (n + block_size - 1) / block_size;
}

/// Which thread works on which blocks: thread t on [first[t], first[t + 1]). Neighbouring blocks stay on one
/// thread and, from step to step, the same one, whose cache then holds them.
struct Shares {
  std::vector<Index> first{0, 0};
  int threads() const { return static_cast<int>(first.size()) - 1; }
  /// Cuts blocks of the given costs into shares of about equal cost for all threads, or so many parts.
  static Shares of(const std::vector<double>& cost);
  static Shares of(const std::vector<double>& cost, int parts);
  static Shares even(Index blocks);
};

/// Calls `body(t)` for every t in [0, n) on threads of their own; on the calling thread if n is 1.
template <class Body>
void on_threads(int n, const Body& body) {
#pragma omp parallel for schedule(static, 1) num_threads(n) if (n > 1)
  for (int t = 0; t < n; ++t) body(t);
}

/// Calls `body(begin, end)` for consecutive blocks of [0, n); a block is worked on by one thread.
template <class Body>
void for_each_block(Index n, const Body& body) {
  const Index blocks = block_count(n);
#pragma omp parallel for schedule(static) if (blocks > 1)
  for (Index b = 0; b < blocks; ++b) body(b * block_size, std::min(n, (b + 1) * block_size));
}

/// Calls `body(i)` for every i in [0, n).
template <class Body>
void for_each(Index n, const Body& body) {
  for_each_block(n, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) body(i);
  });
}

/// What `body(begin, end, out)` appends to `out` for all blocks of [0, n), in block order.
template <class T, class Body>
void collect(Index n, std::vector<T>& out, const Body& body) {
  const std::size_t blocks = block_count(n), shares = blocks > 1 ? threads() : 1;
  std::vector<std::vector<T>> found(shares);
  on_threads(static_cast<int>(shares), [&](int t) {
    for (std::size_t b = blocks * t / shares; b < blocks * (t + 1) / shares; ++b) {
      const Index begin = static_cast<Index>(b) * block_size;
      body(begin, std::min(n, begin + block_size), found[t]);
    }
  });
  out.clear();
  for (const auto& some : found) out.insert(out.end(), some.begin(), some.end());
}

/// Combines `body(begin, end)` of all blocks in block order. T needs no more than a copy and `combine(T, T)`.
template <class T, class Body, class Combine>
T reduce(Index n, T start, const Body& body, const Combine& combine) {
  static_assert(!std::is_same_v<T, bool>, "threads would write bits of one word: use char");
  const Index blocks = block_count(n);
  std::vector<T> part(blocks, start);
#pragma omp parallel for schedule(static) if (blocks > 1)
  for (Index b = 0; b < blocks; ++b) part[b] = body(b * block_size, std::min(n, (b + 1) * block_size));
  for (const T& p : part) start = combine(start, p);
  return start;
}

/// Sum of `term(i)` over [0, n), the same bits on any number of threads.
template <class Term>
Real sum(Index n, const Term& term) {
  return reduce(
      n, Real(0),
      [&](Index begin, Index end) {
        Real s = 0;
        for (Index i = begin; i < end; ++i) s += term(i);
        return s;
      },
      [](Real a, Real b) { return a + b; });
}

/// Largest `term(i)` over [0, n); -infinity for n = 0.
template <class Term>
Real maximum(Index n, const Term& term) {
  return reduce(
      n, -std::numeric_limits<Real>::infinity(),
      [&](Index begin, Index end) {
        Real s = -std::numeric_limits<Real>::infinity();
        for (Index i = begin; i < end; ++i) s = std::max(s, Real(term(i)));
        return s;
      },
      [](Real a, Real b) { return std::max(a, b); });
}

}  // namespace courant
