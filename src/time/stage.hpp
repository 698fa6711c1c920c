#pragma once
#include <vector>

#include "state/world.hpp"
#include "time/pass_timer.hpp"
#include "time/schedule.hpp"

namespace courant {

/// Runs the passes of a StagePlan on all threads.
class Stage {
 public:
  Stage(StagePlan plan, const World& world, PassTimer& timer);
  void run(World& world, const Clock& clock);

 private:
  /// The entities of a pass, and their blocks by thread.
  struct Work {
    Index n = 0;
    const Shares* shares = nullptr;
  };
  void share_work(const World& world);
  void exchange(World& world);
  void run_each_checked(World& world, const Clock& clock);
  void run_share(World& world, const Clock& clock, int thread, std::size_t first_pass, std::size_t last_pass);
  /// Seconds of a thread in each pass, on separate cache lines.
  struct alignas(64) Seconds {
    std::vector<double> of_pass;
  };
  /// Of a set without shares by the neighbour search: evenly.
  struct EvenShares {
    const FieldSet* set;
    Index blocks = -1;
    int threads = 0;
    Shares shares{};
  };
  StagePlan plan_;
  PassTimer& timer_;
  std::size_t waiting_;
  std::vector<Exchanger*> exchangers_;
  std::vector<std::size_t> rows_;
  std::vector<std::size_t> parts_;  ///< first passes behind barriers, and the end
  std::vector<Work> work_;
  std::vector<EvenShares> even_;  ///< one of each other set
  std::vector<double> serial_;
  std::vector<Seconds> seconds_;
};

}  // namespace courant
