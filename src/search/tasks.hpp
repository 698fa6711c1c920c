#pragma once
#include <vector>

#include "parallel/parallel.hpp"

namespace courant {

/// The tasks that threads share: contiguous ranges of blocks, each done by one thread. Within a task a loop
/// may add to particles of other blocks, if what goes beyond the task goes to a buffer of its own.
/// Where they are cut depends on the lists of neighbours alone, so sums have the same bits on any number of
/// threads.
class Tasks {
 public:
  static constexpr Index least = 8, most = 256;  ///< how many, where there are as many blocks
  struct Task {
    Index begin, end;  ///< particles; begin is a multiple of block_size
    Index reach;       ///< behind the last particle that lists of the task hold and that has a list
    Index earliest;    ///< the first task that may reach into this one
    Index offset;      ///< sum of reach - begin of the tasks before
  };

  /// `cost` and `reach` of each block of particles [0, n).
  void cut(Index n, const std::vector<double>& cost, const std::vector<Index>& reach);
  Index count() const { return static_cast<Index>(tasks_.size()); }
  const Task& operator[](Index s) const { return tasks_[s]; }
  /// The task that block `b` belongs to.
  Index of_block(Index b) const { return of_block_[b]; }
  /// Sum of reach - begin.
  Index total() const { return total_; }
  /// Blocks for as many threads as there are now, whole tasks for each.
  Shares shares() const;

 private:
  std::vector<Task> tasks_;
  std::vector<Index> of_block_;
  std::vector<double> cost_;  ///< of each task
  Index total_ = 0;
};

}  // namespace courant
