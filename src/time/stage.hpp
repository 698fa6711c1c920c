#pragma once
#include <memory>
#include <vector>

#include "state/world.hpp"
#include "time/pass_timer.hpp"

namespace courant {

/// Block passes that threads work through without waiting for each other in between, but where a pass waits.
class Stage {
 public:
  explicit Stage(PassTimer& timer) : timer_(timer), waiting_(timer.row("waiting for threads")) {}
  void add(std::shared_ptr<BlockPass> pass);
  template <class List>
  void add_all(const List& passes) {
    for (const auto& pass : passes) add(pass);
  }
  /// Every pass over blocks of particles [0, n), shared as `shares` says.
  void run(World& world, const Clock& clock, Index n, const Shares& shares);

 private:
  void run_share(World& world, const Clock& clock, Index n, const Shares& shares, int thread,
                 std::size_t first_pass, std::size_t last_pass);
  /// A thread's seconds in each pass; on lines of its own, so that threads do not share one.
  struct alignas(64) Seconds {
    std::vector<double> of_pass;
  };
  PassTimer& timer_;
  std::size_t waiting_;
  std::vector<std::shared_ptr<BlockPass>> passes_;
  std::vector<std::size_t> rows_;
  std::vector<std::size_t> parts_;  ///< where passes begin before which threads wait, and the end
  std::vector<double> serial_;
  std::vector<Seconds> seconds_;
};

}  // namespace courant
