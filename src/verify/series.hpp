#pragma once
// Numbers out of curves, and differences between curves.
#include <optional>
#include <string>
#include <vector>

#include "base/real.hpp"

namespace courant {

/// A curve; x rises. shape of both: (n)
struct Series {
  std::vector<Real> x, y;
  std::size_t size() const { return x.size(); }
};

/// A number, or the reason why there is none.
struct Taken {
  std::optional<Real> value;
  std::string why;
};

/// Points with from <= x <= to.
Series window(const Series& series, Real from, Real to);

/// y at x by linear interpolation; nothing outside the range of the series. A place that is beyond an end by
/// 1e-6 of the range is taken for that end.
std::optional<Real> value_at(const Series& series, Real x);

/// The number that `take` names: final, mean (of the samples), min, max, at (needs `at`), period, decay,
/// slope (least squares), growth (largest over first value).
Taken take_number(const Series& series, const std::string& take, std::optional<Real> at);

/// Mean distance of the upward crossings of the trend [x]. The trend is a straight line, fitted together with
/// a sine of the period found so far, so that a part of an oscillation at the ends does not tilt it. A
/// crossing counts where the series goes from a quarter of its standard deviation below the trend to as much
/// above it: noise about the trend does not. Needs two crossings.
Taken period_of(const Series& series);

/// Rate b of the exponential a exp(-b x) fitted by least squares to the logarithms of the peaks of |y| [1/x];
/// b < 0 is growth. A peak counts where |y| falls by a quarter of it on both sides. Needs two peaks.
Taken decay_of(const Series& series);

/// Norm `norm` (l1: mean of |y|, l2: root of the mean square, linf: largest |y|) of values; shape: (n), n >
/// 0.
Real norm_of(const std::vector<Real>& values, const std::string& norm);

/// Slope of the straight line through the points by least squares; nothing with fewer than two different x.
std::optional<Real> slope_of(const std::vector<Real>& x, const std::vector<Real>& y);

/// At most `most` points, evenly chosen, the ends among them.
Series thinned(const Series& series, std::size_t most);

}  // namespace courant
