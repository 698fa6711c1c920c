#pragma once
#include <algorithm>
#include <cmath>

#include "base/real.hpp"

namespace courant {

/// When an output is due. A state due at t_out = k interval is written at the cycle with t <= t_out < t + dt,
/// as LS-DYNA does, first at t = 0; several due times within one step give one state.
class OutputSchedule {
 public:
  /// interval [T]; 0 or less: never due.
  explicit OutputSchedule(Real interval = 0) : interval_(interval) {}

  /// Whether a state is due in [t, t + dt). Changes nothing.
  bool is_due(Real t, Real dt) const { return interval_ > 0 && next() < t + dt; }

  /// Whether a state is due in [t, t + dt); if so, the next one is due after that step.
  bool take(Real t, Real dt) {
    if (!is_due(t, dt)) return false;
    k_ = std::max(k_ + 1, std::floor((t + dt) / interval_));
    while (next() < t + dt) k_ += 1;
    return true;
  }

  /// For a restart at time t: what was due before t is taken as written.
  void skip_to(Real t) {
    if (interval_ <= 0) return;
    k_ = std::max<Real>(0, std::floor(t / interval_));
    while (next() < t) k_ += 1;
  }

  Real count() const { return k_; }  ///< of intervals at which the next one is due
  /// For a restart with the same interval: as it was.
  void set_count(Real count) { k_ = count; }

  Real next() const { return k_ * interval_; }  ///< product, not a running sum: no drift [T]
  Real interval() const { return interval_; }

 private:
  Real interval_;
  Real k_ = 0;  // whole number, kept as Real for the product
};

}  // namespace courant
