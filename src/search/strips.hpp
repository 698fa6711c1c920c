#pragma once
#include <vector>

#include "parallel/parallel.hpp"

namespace courant {

/// The tasks that threads share: contiguous ranges of blocks, each done by one thread: within a strip, a loop
/// may add to particles of other blocks, if what goes beyond the strip goes to memory of the strip's own.
/// Where they are cut depends on the lists of neighbours alone, so sums have the same bits on any number of
/// threads.
class Strips {
 public:
  static constexpr Index least = 8, most = 256;  ///< how many, where there are as many blocks
  struct Strip {
    Index begin, end;  ///< particles; begin is a multiple of block_size
    Index reach;       ///< behind the last particle that lists of the strip hold and that has a list
    Index earliest;    ///< the first strip that may reach into this one
    Index offset;      ///< sum of reach - begin of the strips before
  };

  /// `cost` and `reach` of each block of particles [0, n).
  void cut(Index n, const std::vector<double>& cost, const std::vector<Index>& reach);
  Index count() const { return static_cast<Index>(strips_.size()); }
  const Strip& operator[](Index s) const { return strips_[s]; }
  /// The strip that block `b` belongs to.
  Index of_block(Index b) const { return of_block_[b]; }
  /// Sum of reach - begin.
  Index total() const { return total_; }
  /// Blocks for as many threads as there are now, whole strips for each.
  Shares shares() const;

 private:
  std::vector<Strip> strips_;
  std::vector<Index> of_block_;
  std::vector<double> cost_;  ///< of each strip
  Index total_ = 0;
};

}  // namespace courant
