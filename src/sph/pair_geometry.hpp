#pragma once
// The lists of neighbours as pair loops take them, and the memory in which the loop of the rates leaves
// kernel gradients for the loop of the forces.
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "parallel/buffer.hpp"
#include "search/neighbours.hpp"
#include "sph/pair_loops.hpp"
#include "state/saved_state.hpp"

namespace courant {

class PairGeometry {
 public:
  static constexpr std::int64_t most_kept_bytes = 128 << 20;
  /// Gradients are kept where they need no more than `most_kept` bytes and h is the same for all.
  /// `eps` > 0: they are kept from step to step, whatever they need, until two particles may have moved eps h
  /// towards each other.
  PairGeometry(std::shared_ptr<Neighbours> neighbours, bool uniform_h,
               std::int64_t most_kept = most_kept_bytes, Real eps = 0)
      : neighbours_(std::move(neighbours)),
        most_kept_(!uniform_h ? -1
                   : eps > 0  ? std::numeric_limits<std::int64_t>::max()
                              : most_kept),
        eps_(eps) {}

  /// At the start of the rates: decides whether gradients are kept. They spare the forces a root and the
  /// kernel of each pair; memory is the limit. See docs/performance.md.
  void prepare() {
    kept_ = neighbours_->entries() * std::int64_t(lanes * sizeof(Real)) <= most_kept_;
    const Index blocks = kept_ ? neighbours_->blocks() : 0;
    if (static_cast<Index>(g_.size()) != blocks) g_.resize(blocks);
  }
  bool kept() const { return kept_; }

  /// Before a motion: whether gradients must be worked out anew after it, since particles as fast as in the
  /// last step would pass the bound with the next one.
  bool will_expire(Real h, Real dt) const { return eps_ == 0 || 2 * (moved_ + fastest_ * dt) > eps_ * h; }
  bool watches_motion() const { return eps_ > 0; }
  /// After a motion at a highest speed of `fastest` [L/T].
  void moved(Real fastest, Real dt, bool expired) {
    fastest_ = fastest;
    moved_ += fastest * dt;
    if (expired) expire();
  }
  void expire() {
    moved_ = 0;
    valid_ = false;
  }
  /// True while the gradients of an earlier step still hold; asking makes the next ones valid.
  bool take_valid() { return std::exchange(valid_, kept_); }

  /// Not the gradients: they follow from the places at which they were worked out.
  void keep(Archive& archive) {
    archive("moved", moved_);
    archive("fastest", fastest_);
    archive("valid", valid_);
  }
  /// Whether gradients of an earlier step will be read, so that they must be there after loading.
  bool valid() const { return valid_; }

  PairLists lists(Index begin, Index end) {
    const Index b = begin / block_size;
    Real* g = kept_ ? g_[b].grow_to(std::size_t(neighbours_->entries(b)) * lanes) : nullptr;
    return {neighbours_->list(b), neighbours_->starts(b), g, begin, end};
  }

 private:
  static constexpr Index lanes = Neighbours::lanes;
  std::shared_ptr<Neighbours> neighbours_;
  std::int64_t most_kept_;
  Real eps_;
  Real moved_ = 0, fastest_ = 0;  ///< bound of what a particle moved since [L]; [L/T]
  bool kept_ = false, valid_ = false;
  std::vector<Buffer<Real>> g_;  ///< of each block
};

}  // namespace courant
