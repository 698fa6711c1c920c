#pragma once
// Copies of the state in memory, for a restart file when a run stops in error.
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "state/saved_state.hpp"
#include "state/world.hpp"
#include "time/guard.hpp"

namespace courant {

struct StateCopy {
  SavedState state;
  Real t = 0;  ///< [T]
  std::int64_t cycle = 0;
  bool has_files = false;  ///< how far the files had come is in the state; set by the thread that writes
};

/// When to copy the state, and which copy to take when the run has stopped. Copies are made just after a look
/// of the guard, at least `spacing` steps apart, and so seldom that they cost 0.5 % of the run. Two are held:
/// after the older one the guard found the run sane again, so that what broke it has hardly begun there. When
/// copies are made depends on the clock; they change nothing of the run.
class StateCopies {
 public:
  static constexpr std::int64_t spacing = 4 * Guard::interval;       ///< steps
  static constexpr int least_rest = 200;                             ///< times what a copy takes
  static constexpr std::size_t most_bytes = std::size_t{512} << 20;  ///< of one copy

  StateCopies(const World& world, bool wanted, std::int64_t first_cycle);
  /// Why there will be none although they are wanted; else empty.
  const std::string& refusal() const { return refusal_; }

  /// Between two steps.
  bool is_due(const Clock& clock) const;
  /// Makes a copy with `save` and forgets the oldest but one.
  std::shared_ptr<StateCopy> take(const Clock& clock, const std::function<void(SavedState&)>& save);
  /// The older copy, or the only one, or nullptr.
  std::shared_ptr<StateCopy> best() const { return older_ ? older_ : newest_; }

 private:
  using Timer = std::chrono::steady_clock;
  bool wanted_;
  std::string refusal_;
  std::int64_t last_cycle_;
  Timer::time_point rest_until_{};
  std::shared_ptr<StateCopy> newest_, older_;
};

/// About what the fields of a world take in a copy [bytes].
std::size_t saved_bytes(const World& world);

}  // namespace courant
