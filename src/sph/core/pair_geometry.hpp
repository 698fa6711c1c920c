#pragma once
// The lists of neighbours as pair loops take them, the memory in which the loop of the rates leaves kernel
// gradients for the loop of the forces, and that in which both leave what partners get.
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "parallel/buffer.hpp"
#include "search/neighbours.hpp"
#include "sph/core/reduction_loops.hpp"

namespace courant {

class PairGeometry {
 public:
  static constexpr std::int64_t most_kept_bytes = 16 << 20;
  /// Where h is the same for all, pairs are worked out once, and gradients are kept where they need no more
  /// than `most_kept` bytes.
  PairGeometry(std::shared_ptr<Neighbours> neighbours, bool uniform_h,
               std::int64_t most_kept = most_kept_bytes)
      : neighbours_(std::move(neighbours)), once_(uniform_h), most_kept_(uniform_h ? most_kept : -1) {
    if (once_)
      neighbours_->cut_tasks();
    else
      neighbours_->need_whole_lists();
  }

  /// What `lists` gives to the loop of the rates and to that of the forces, and `shares` to the reductions.
  void declare_rates(Accesses& a) const {
    if (once_) a.writes(contributions_).writes(gradients_);
  }
  void declare_forces(Accesses& a) const {
    if (once_) a.writes(contributions_).reads(gradients_);
  }
  void declare_reduction(Accesses& a) const { a.reads(contributions_, Reach::others); }

  /// Whether partners must get their shares from where the loops leave them.
  bool once() const { return once_; }

  /// At the start of the rates: decides whether gradients are kept. They spare the forces a root and the
  /// kernel of each pair; memory is the limit. See docs/performance.md.
  void prepare() {
    kept_ = neighbours_->entries_once() * std::int64_t(lanes * sizeof(Real)) <= most_kept_;
    const Index blocks = kept_ ? neighbours_->blocks() : 0;
    if (static_cast<Index>(blocks_.size()) != blocks) blocks_.resize(blocks);
  }
  bool kept() const { return kept_; }

  /// At the start of rates and forces: `numbers` for each partner. `threads`: the blocks of each thread.
  void make_room_for_shares(Index numbers, const Shares& threads) {
    if (!once_) return;
    const Tasks& tasks = neighbours_->tasks();
    for (const Index b : threads.first)
      if (b < neighbours_->blocks() && tasks[tasks.of_block(b)].begin != b * block_size)
        throw std::logic_error("two threads would work on one task");
    share_size_ = numbers;
    shares_.grow_to(std::size_t(tasks.total()) * numbers);
  }

  /// Blocks of a task are requested in order, by one thread.
  PairLists lists(Index begin, Index end) {
    const Index b = begin / block_size;
    PairLists out{.list = neighbours_->list(b),
                  .start = neighbours_->starts(b),
                  .sections = neighbours_->sections(b),
                  .begin = begin,
                  .end = end};
    if (once_) {
      note_access(contributions_);
      const Tasks::Task& task = neighbours_->tasks()[neighbours_->tasks().of_block(b)];
      out.task_begin = task.begin;
      out.shares = shares_.data() + std::size_t(task.offset) * share_size_;
      if (begin == task.begin)
        std::fill_n(out.shares, std::size_t(task.reach - task.begin) * share_size_, 0.0);
    }
    if (!kept_) return out;
    note_access(gradients_);
    const std::size_t entries = neighbours_->entries_once(b);
    out.kept = blocks_[b].list.grow_to(entries), out.kept_start = blocks_[b].start.data();
    out.g = blocks_[b].g.grow_to(entries * lanes);
    return out;
  }

  using Sources = std::array<Contributions::Source, Tasks::most>;
  /// What particles of the block [begin, end) got as partners; `sources` is space for it.
  Contributions shares(Index begin, Index end, Sources& sources) const {
    note_access(contributions_);
    const Tasks& tasks = neighbours_->tasks();
    const Index own = tasks.of_block(begin / block_size);
    Contributions::Source* next = sources.data();
    for (Index s = tasks[own].earliest; s <= own; ++s) {
      const Tasks::Task& task = tasks[s];
      if (task.reach > begin)
        *next++ = {shares_.data() + std::size_t(task.offset + begin - task.begin) * share_size_, task.reach};
    }
    return {sources.data(), next, begin, end};
  }

 private:
  static constexpr Index lanes = Neighbours::lanes;
  struct Block {
    Buffer<Index> list;
    Buffer<Real> g;
    std::array<Index, Neighbours::groups_per_block + 1> start;
  };
  Resource contributions_{"contributions to j", "particles"}, gradients_{"gradients of pairs", "particles"};
  std::shared_ptr<Neighbours> neighbours_;
  bool once_;
  std::int64_t most_kept_;
  bool kept_ = false;
  Index share_size_ = 0;
  Buffer<Real> shares_;
  std::vector<Block> blocks_;
};

}  // namespace courant
