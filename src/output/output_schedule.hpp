#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "base/real.hpp"

namespace courant {

/// When an output is due. A state due at t_out is written at the cycle with t <= t_out < t + dt, as LS-DYNA
/// does; several due times within one step give one state. Times that differ by round-off count as one.
class OutputSchedule {
 public:
  /// The due time after a due time; infinity: none. [T]
  using After = std::function<Real(Real due)>;

  /// Due at k interval, first at t = 0. interval [T]; 0 or less: never due.
  OutputSchedule(Real interval = 0) : interval_(interval) {}
  /// Due at `first`, then at the times of `after`.
  OutputSchedule(Real first, After after) : first_(first), next_(first), after_(std::move(after)) {}

  bool is_wanted() const { return interval_ > 0 || after_; }
  /// Whether a state is due in [t, t + dt). Changes nothing.
  bool is_due(Real t, Real dt) const { return is_wanted() && next() < before(t + dt); }

  /// Whether a state is due in [t, t + dt); if so, the next one is due after that step.
  bool take(Real t, Real dt) {
    if (!is_due(t, dt)) return false;
    if (!after_) k_ = std::max(k_ + 1, std::floor(before(t + dt) / interval_));
    while (next() < before(t + dt)) go_on();
    return true;
  }

  /// For a restart at time t: outputs due before t count as written.
  void skip_to(Real t) {
    if (!is_wanted()) return;
    if (after_)
      next_ = first_;
    else
      k_ = std::max<Real>(0, std::floor(t / interval_));
    while (next() < before(t)) go_on();
  }

  Real next() const { return after_ ? next_ : k_ * interval_; }  ///< product: no drift [T]
  Real interval() const { return interval_; }                    ///< 0: by `after`, or never due [T]

 private:
  /// Relative error of a sum of a million steps.
  static Real before(Real t) { return t - 1e-10 * std::abs(t); }
  void go_on() {
    if (!after_) {
      k_ = std::max(k_ + 1, std::nextafter(k_, std::numeric_limits<Real>::infinity()));
      return;
    }
    const Real due = after_(next_);
    next_ = due > next_ ? due : std::numeric_limits<Real>::infinity();  // below round-off: no end otherwise
  }

  Real interval_ = 0;
  Real k_ = 0;  // whole number, kept as Real for the product
  Real first_ = 0, next_ = 0;
  After after_{};
};

}  // namespace courant
