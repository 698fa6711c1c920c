#include "parallel/parallel.hpp"

#include <omp.h>

namespace courant {

namespace {
int wanted_threads = 0;
}

void set_threads(int threads) {
  wanted_threads = threads > 0 ? threads : omp_get_num_procs();
  omp_set_num_threads(wanted_threads);
}

Shares Shares::of(const std::vector<double>& cost) {
  return of(cost, courant::threads());
}

Shares Shares::of(const std::vector<double>& cost, int parts) {
  const Index blocks = static_cast<Index>(cost.size());
  const int n = std::max(1, std::min<int>(parts, blocks));
  double total = 0, done = 0;
  for (const double c : cost) total += c;
  Shares shares;
  shares.first.assign(1, 0);
  for (Index b = 0; b < blocks;
       ++b) {  // a share ends with the block whose middle passes its part of the cost
    const int t = static_cast<int>(shares.first.size());
    if (t < n && done + 0.5 * cost[b] > total * t / n) shares.first.push_back(b);
    done += cost[b];
  }
  shares.first.resize(n, blocks);
  shares.first.push_back(blocks);
  return shares;
}

Shares Shares::even(Index blocks) {
  return of(std::vector<double>(blocks, 1.0));
}

int threads() {
  return wanted_threads > 0 ? wanted_threads : omp_get_max_threads();
}

}  // namespace courant
