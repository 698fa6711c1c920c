#pragma once
// The lists of neighbours as pair loops take them, and the memory in which the loop of the rates leaves
// kernel gradients for the loop of the forces.
#include <memory>
#include <vector>

#include "parallel/buffer.hpp"
#include "search/neighbours.hpp"
#include "sph/pair_loops.hpp"

namespace courant {

class PairGeometry {
 public:
  PairGeometry(std::shared_ptr<Neighbours> neighbours, bool uniform_h)
      : neighbours_(std::move(neighbours)), uniform_h_(uniform_h) {}

  /// At the start of the rates: decides whether gradients are kept. They are where they fit into the caches;
  /// fetching them from memory would take longer than working them out again. See docs/performance.md.
  void prepare() {
    kept_ = uniform_h_ && neighbours_->entries() * std::int64_t(lanes * sizeof(Real)) <= most_kept_bytes;
    const Index blocks = kept_ ? neighbours_->blocks() : 0;
    if (static_cast<Index>(g_.size()) != blocks) g_.resize(blocks);
  }
  bool kept() const { return kept_; }

  PairLists lists(Index begin, Index end) {
    const Index b = begin / block_size;
    Real* g = kept_ ? g_[b].grow_to(std::size_t(neighbours_->entries(b)) * lanes) : nullptr;
    return {neighbours_->list(b), neighbours_->starts(b), g, begin, end};
  }

 private:
  static constexpr Index lanes = Neighbours::lanes;
  static constexpr std::int64_t most_kept_bytes = 16 << 20;
  std::shared_ptr<Neighbours> neighbours_;
  bool uniform_h_, kept_ = false;
  std::vector<Buffer<Real>> g_;  ///< of each block
};

}  // namespace courant
