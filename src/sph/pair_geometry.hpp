#pragma once
// The lists of neighbours as pair loops take them, and the memory in which the loop of the rates leaves
// kernel gradients for the loop of the forces.
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "parallel/buffer.hpp"
#include "search/neighbours.hpp"
#include "sph/pair_loops.hpp"

namespace courant {

class PairGeometry {
 public:
  static constexpr std::int64_t most_kept_bytes = 16 << 20;
  /// Gradients are kept where they need no more than `most_kept` bytes and h is the same for all.
  PairGeometry(std::shared_ptr<Neighbours> neighbours, bool uniform_h,
               std::int64_t most_kept = most_kept_bytes)
      : neighbours_(std::move(neighbours)), most_kept_(uniform_h ? most_kept : -1) {}

  /// At the start of the rates: decides whether gradients are kept. They spare the forces a root and the
  /// kernel of each pair; memory is the limit. See docs/performance.md.
  void prepare() {
    kept_ = neighbours_->entries() * std::int64_t(lanes * sizeof(Real)) <= most_kept_;
    const Index blocks = kept_ ? neighbours_->blocks() : 0;
    if (static_cast<Index>(blocks_.size()) != blocks) blocks_.resize(blocks);
  }
  bool kept() const { return kept_; }

  PairLists lists(Index begin, Index end) {
    const Index b = begin / block_size;
    PairLists out{neighbours_->list(b),
                  neighbours_->starts(b),
                  neighbours_->beyond(b),
                  begin,
                  end,
                  nullptr,
                  nullptr,
                  nullptr};
    if (!kept_) return out;
    const std::size_t entries = neighbours_->entries(b);
    out.kept = blocks_[b].list.grow_to(entries), out.kept_start = blocks_[b].start.data();
    out.g = blocks_[b].g.grow_to(entries * lanes);
    return out;
  }

 private:
  static constexpr Index lanes = Neighbours::lanes;
  struct Block {
    Buffer<Index> list;
    Buffer<Real> g;
    std::array<Index, Neighbours::groups_per_block + 1> start;
  };
  std::shared_ptr<Neighbours> neighbours_;
  std::int64_t most_kept_;
  bool kept_ = false;
  std::vector<Block> blocks_;
};

}  // namespace courant
