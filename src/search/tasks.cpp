#include "search/tasks.hpp"

#include <numeric>

namespace courant {

namespace {

// About as long as what they reach into, so that they hold numbers for each particle twice; in large scenes
// enough for many threads (32 instead of 16 cost 1 % of a step of 100 000 particles in 3D). A multiple of
// four, so that most numbers of threads get as many each.
Index wanted_tasks(Index n, const std::vector<Index>& reach) {
  double ahead = 0;
  for (std::size_t b = 0; b < reach.size(); ++b)
    ahead += static_cast<double>(reach[b] - static_cast<Index>(b) * block_size);
  ahead = std::max(1.0, ahead / static_cast<double>(reach.size()));
  const Index wanted = std::max(static_cast<Index>(n / ahead), std::min<Index>(32, n / 2048));
  return std::clamp((wanted + 3) / 4 * 4, Tasks::least, Tasks::most);
}

}  // namespace

void Tasks::cut(Index n, const std::vector<double>& cost, const std::vector<Index>& reach) {
  const Index blocks = static_cast<Index>(cost.size());
  tasks_.clear(), cost_.clear();
  of_block_.resize(blocks);
  total_ = 0;
  const Shares parts = Shares::of(cost, static_cast<int>(blocks > 0 ? wanted_tasks(n, reach) : 1));
  for (int s = 0; s < parts.threads(); ++s) {
    const Index from = parts.first[s], to = parts.first[s + 1];
    if (from == to) continue;
    Task task{from * block_size, std::min(n, to * block_size), 0, 0, total_};
    task.reach = std::max(task.end, *std::max_element(reach.begin() + from, reach.begin() + to));
    // those in between may reach less far
    while (task.earliest < count() && tasks_[task.earliest].reach <= task.begin) ++task.earliest;
    std::fill(of_block_.begin() + from, of_block_.begin() + to, count());
    total_ += task.reach - task.begin;
    tasks_.push_back(task);
    cost_.push_back(std::accumulate(cost.begin() + from, cost.begin() + to, 0.0));
  }
}

Shares Tasks::shares() const {
  Shares shares = Shares::of(cost_);
  for (Index& first : shares.first)
    first = first < count() ? tasks_[first].begin / block_size : static_cast<Index>(of_block_.size());
  return shares;
}

}  // namespace courant
