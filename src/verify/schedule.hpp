#pragma once
// How long the remaining runs will take, from those that are done.
#include <chrono>
#include <string>
#include <vector>

namespace courant {

/// "45 s", "3 min 05 s", "2 h 10 min".
std::string duration_text(double seconds);

/// Runs are expected to take as long as their cost (in any unit), in proportion to runs of the same case that
/// are done, or to all that are done while there are none of the case.
class RunSchedule {
 public:
  struct Run {
    std::size_t of_case = 0;
    double cost = 0;
  };
  RunSchedule(std::vector<Run> runs, int at_once);
  void started(std::size_t run);
  void ended(std::size_t run, double wall_seconds);
  std::size_t done() const { return done_; }
  std::size_t size() const { return runs_.size(); }
  /// Seconds until all are done; negative while no run is done.
  double seconds_left() const;

 private:
  enum class State { waiting, running, done };
  struct Entry : Run {
    State state = State::waiting;
    double seconds = 0;
    std::chrono::steady_clock::time_point start{};
  };
  std::vector<Entry> runs_;
  int at_once_ = 1;
  std::size_t done_ = 0;
};

}  // namespace courant
