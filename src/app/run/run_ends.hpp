#pragma once
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "app/run/simulation.hpp"
#include "state/ending.hpp"

namespace courant {

/// What ends a run before its end time.
struct RunEnd {
  std::string reason;
  bool interrupted = false, wants_restart = false;  ///< the run is not complete
};

/// A signal, ENDCYC, CPUTIM of *CONTROL_CPU, *TERMINATION_...
class RunEnds {
 public:
  /// `stop`: set by a signal; `program`: that may call the run off. Both may be null.
  RunEnds(Simulation& simulation, const std::atomic<bool>* stop, const Program* program);
  /// Between two steps. `cpu`: time of all threads since this call of the program began [s]
  /// Throws RunError where the steps have become so short that the end cannot be reached.
  std::optional<RunEnd> reached(double cpu) const;
  /// A signal, or CPUTIM: what ends the relaxation in front of a run, too.
  std::optional<RunEnd> called_off(double cpu) const;

 private:
  void stop_without_progress(const Clock& clock) const;

  Simulation& s_;
  const std::atomic<bool>* stop_;
  const Program* program_;
  double most_cpu_ = 0;  ///< 0: no limit [s]
  std::vector<const Ending*> endings_;
};

}  // namespace courant
