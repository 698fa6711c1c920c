#pragma once
#include <cstdint>
#include <functional>

#include "base/real.hpp"

namespace courant {

class Simulation;

/// A program that follows a run: it is called at time levels, where x, p and f are of the same time, before
/// the kick.
struct ProgramHook {
  /// Returns false where the run is to end after this step; must not throw. Empty: nothing follows the run.
  std::function<bool(Simulation&)> call{};
  std::int64_t every_steps = 0;  ///< > 0: once in so many steps
  Real every_time = 0;           ///< > 0: at multiples of it, and at the end [T]
};

/// When a hook is due, and whether it has called the run off.
class Program {
 public:
  explicit Program(const ProgramHook& hook) : hook_(hook) {}
  /// In a step from t to t + dt, to which belongs what is due in between.
  void at(Simulation& simulation, Real t, Real dt);
  void at_end(Simulation& simulation);
  bool called_off() const { return called_off_; }

 private:
  bool is_due(std::int64_t cycle, Real t, Real dt);

  const ProgramHook& hook_;
  Real next_ = 0;  ///< the multiple that is due next
  bool called_off_ = false;
};

}  // namespace courant
