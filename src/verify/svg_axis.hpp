#pragma once
#include <span>
#include <string>
#include <vector>

#include "base/real.hpp"

namespace courant::report {

/// An axis of a chart: its range and where it carries numbers.
struct Axis {
  struct Tick {
    Real value = 0;
    std::string label;
  };
  bool logarithmic = false;
  Real from = 0, to = 1;
  std::vector<Tick> ticks;

  /// Whether a value has a place: finite, and positive on a logarithmic axis.
  bool shows(Real value) const;
  /// 0 at the beginning of the axis, 1 at its end; the value must have a place.
  Real place(Real value) const;
};

/// An axis that shows all values that can have a place on it, with at least two ticks. Without any such value
/// it goes from 1 to 10, or from 0 to 1. `percentages`: fractions are labelled as per cent, unless their
/// range is so wide that powers of ten are easier to read.
Axis make_axis(bool logarithmic, std::span<const Real> values, bool percentages = false);

}  // namespace courant::report
