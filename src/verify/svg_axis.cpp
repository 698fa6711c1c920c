#include "verify/svg_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verify/report_text.hpp"

namespace courant::report {
namespace {

constexpr Real smallest_ratio = 3;  // of the ends of a logarithmic axis: one narrower carries too few numbers
constexpr int most_decades = 7;     // with a number each

/// Ticks at these digits of each decade between the ends.
std::vector<Real> digits_of_decades(const Axis& axis, std::span<const int> digits) {
  std::vector<Real> values;
  const int first = static_cast<int>(std::floor(std::log10(axis.from)));
  const int last = static_cast<int>(std::ceil(std::log10(axis.to)));
  for (int decade = first; decade <= last; ++decade)
    for (const int digit : digits) {
      // Parsed, as the product of a digit and a power may miss the nearest number.
      const Real value = std::stod(fmt::format("{}e{}", digit, decade));
      if (value >= axis.from && value <= axis.to) values.push_back(value);
    }
  return values;
}

std::vector<Real> logarithmic_ticks(const Axis& axis) {
  static constexpr int tens[] = {1}, few[] = {1, 2, 5}, all[] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::vector<Real> values = digits_of_decades(axis, tens);
  if (values.size() < 3 && axis.to / axis.from < 300) values = digits_of_decades(axis, few);
  if (values.size() < 2) values = digits_of_decades(axis, all);
  const std::size_t stride = (values.size() + most_decades - 1) / most_decades;
  std::vector<Real> kept;
  for (std::size_t i = 0; i < values.size(); i += stride) kept.push_back(values[i]);
  return kept;
}

std::vector<Real> linear_ticks(Axis& axis) {
  const Real rough = (axis.to - axis.from) / 5;
  const Real decade = std::pow(Real(10), std::floor(std::log10(rough)));
  Real step = 10 * decade;
  for (const Real digit : {5, 2, 1})
    if (digit * decade >= rough * (1 - 1e-9)) step = digit * decade;
  const Real first = std::floor(axis.from / step + 1e-9), last = std::ceil(axis.to / step - 1e-9);
  axis.from = first * step, axis.to = last * step;
  std::vector<Real> values;
  for (Real k = first; k <= last; ++k) values.push_back(k == 0 ? 0 : k * step);
  return values;
}

void set_range(Axis& axis, std::span<const Real> values) {
  bool any = false;
  for (const Real v : values) {
    if (!axis.shows(v)) continue;
    axis.from = any ? std::min(axis.from, v) : v;
    axis.to = any ? std::max(axis.to, v) : v;
    any = true;
  }
  if (!any) {
    axis.from = axis.logarithmic ? 1 : 0, axis.to = axis.logarithmic ? 10 : 1;
  } else if (axis.logarithmic) {
    const Real width = std::log(axis.to) - std::log(axis.from);
    const Real margin = std::exp(0.06 * width + std::max((std::log(smallest_ratio) - width) / 2, Real(0)));
    axis.from /= margin, axis.to *= margin;
    // At the limits of what numbers can be, the axis still has two ends.
    if (!(axis.from > 1e-300)) axis.from = 1e-300;
    if (!(axis.to < 1e300)) axis.to = 1e300;
  } else {
    const Real size = std::max(std::abs(axis.from), std::abs(axis.to));
    if (axis.to - axis.from < 1e-9 * size || size == 0) {
      const Real margin = size == 0 ? 1 : 0.1 * size;
      axis.from -= margin, axis.to += margin;
    }
  }
}

}  // namespace

bool Axis::shows(Real value) const {
  return std::abs(value) < 1e300 && (!logarithmic || value > 1e-300);  // false for NaN
}

Real Axis::place(Real value) const {
  return logarithmic ? (std::log(value) - std::log(from)) / (std::log(to) - std::log(from))
                     : (value - from) / (to - from);
}

Axis make_axis(bool logarithmic, std::span<const Real> values, bool percentages) {
  Axis axis;
  axis.logarithmic = logarithmic;
  set_range(axis, values);
  const std::vector<Real> ticks = logarithmic ? logarithmic_ticks(axis) : linear_ticks(axis);
  const bool as_percent = percentages && axis.from > 5e-6 && axis.to < 200;
  // Enough digits to tell neighbouring ticks apart, too few to show that 0.3 is not 3/10.
  int digits = 6;
  if (!logarithmic) {
    const Real size = std::max(std::abs(axis.from), std::abs(axis.to));
    digits = std::clamp(static_cast<int>(std::log10(size / (ticks[1] - ticks[0]))) + 3, 6, 15);
  }
  for (const Real v : ticks) {
    const Real shown = std::stod(fmt::format("{:.{}e}", as_percent ? 100 * v : v, digits - 1));
    const Real size = std::abs(shown);
    std::string label = fmt::format("{:.{}g}", shown, digits);
    if (size != 0 && (size < 1e-4 || size >= 1e6)) label = number(shown, digits);
    axis.ticks.push_back({v, label + (as_percent ? " %" : "")});
  }
  return axis;
}

}  // namespace courant::report
