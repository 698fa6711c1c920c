// Period and decay of a series.
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "verify/series.hpp"

namespace courant {
namespace {

struct Line {
  Real value = 0, slope = 0;  // at x = 0
};

/// Where the series rises through the line, each crossing from below -margin to above margin once. Several
/// crossings on the way (noise) count as one, in their middle.
std::vector<Real> upward_crossings(const Series& s, const Line& line, Real margin) {
  std::vector<Real> out;
  bool below = false;            // has been below -margin since the last crossing
  std::vector<Real> on_the_way;  // crossings since then
  Real before = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Real d = s.y[i] - line.value - line.slope * s.x[i];
    if (d < -margin) below = true, on_the_way.clear();
    if (i > 0 && below && before < 0 && d >= 0)
      on_the_way.push_back(s.x[i - 1] + (s.x[i] - s.x[i - 1]) * before / (before - d));
    if (below && d > margin && !on_the_way.empty()) {
      out.push_back((on_the_way.front() + on_the_way.back()) / 2);
      below = false;
      on_the_way.clear();
    }
    before = d;
  }
  return out;
}

/// The line in the least squares fit of line + sine of this period.
Line trend(const Series& s, Real period) {
  Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  // about the middle and in units of the range, for the conditioning of the fit
  const Real middle = (s.x.front() + s.x.back()) / 2, range = s.x.back() - s.x.front();
  for (std::size_t k = 0; k < s.size(); ++k) {
    const Real phase = 2 * pi * s.x[k] / period;
    const Eigen::Vector4d terms(1, (s.x[k] - middle) / range, std::cos(phase), std::sin(phase));
    M += terms * terms.transpose();
    right += s.y[k] * terms;
  }
  const Eigen::Vector4d fit = M.inverse() * right;
  const Real slope = fit[1] / range;
  return {fit[0] - slope * middle, slope};
}

/// Height and place of the parabola's top through a largest sample and its neighbours.
std::pair<Real, Real> top_of(const Series& s, std::size_t i) {
  const Real h1 = s.x[i] - s.x[i - 1], h2 = s.x[i + 1] - s.x[i];
  const Real a = s.y[i - 1] - s.y[i], b = s.y[i + 1] - s.y[i];
  const Real curvature = (a / h1 + b / h2) / (h1 + h2), slope = b / h2 - curvature * h2;
  if (!(curvature < 0)) return {s.x[i], s.y[i]};
  const Real d = std::clamp(-slope / (2 * curvature), -h1, h2);
  return {s.x[i] + d, s.y[i] + d * (slope + curvature * d)};
}

}  // namespace

Taken period_of(const Series& s) {
  constexpr std::size_t fewest = 8;
  const Taken none{std::nullopt, "a period needs two upward crossings of the mean"};
  if (s.size() < fewest) return none;
  const Real n = static_cast<Real>(s.size());
  Real mean = 0, square = 0;
  for (const Real y : s.y) mean += y / n;
  for (const Real y : s.y) square += (y - mean) * (y - mean) / n;
  const Real margin = 0.25 * std::sqrt(square);
  if (!(margin > 0)) return none;
  Line line{mean, 0};
  Real period = 0;
  for (int k = 0; k < 6; ++k) {
    const std::vector<Real> crossings = upward_crossings(s, line, margin);
    if (crossings.size() < 2) return none;
    period = (crossings.back() - crossings.front()) / static_cast<Real>(crossings.size() - 1);
    line = trend(s, period);
  }
  return {period, {}};
}

Taken decay_of(const Series& series) {
  Series s = series;
  for (Real& y : s.y) y = std::abs(y);
  std::vector<Real> x, logarithm;
  std::size_t top = 0;  // largest sample since the last valley
  Real valley = 0;      // smallest since the last peak
  bool rising = false;
  if (s.size() > 0) valley = s.y[0];
  for (std::size_t i = 1; i < s.size(); ++i) {
    if (!rising) {
      // a rise counts when it is a third of what it started from, or of the last peak's fall
      valley = std::min(valley, s.y[i]);
      const Real last = logarithm.empty() ? s.y[0] : std::exp(logarithm.back());
      if (s.y[i] > valley + 0.25 * std::abs(last - valley) && s.y[i] > valley * 4 / 3) rising = true, top = i;
    } else if (s.y[i] > s.y[top]) {
      top = i;
    } else if (s.y[i] < 0.75 * s.y[top]) {
      const auto [at, height] = top_of(s, top);
      x.push_back(at);
      logarithm.push_back(std::log(height));
      rising = false;
      valley = s.y[i];
    }
  }
  const auto slope = slope_of(x, logarithm);
  if (!slope) return {std::nullopt, "a decay needs two peaks"};
  return {-*slope, {}};
}

}  // namespace courant
