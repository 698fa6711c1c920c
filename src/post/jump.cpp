#include "post/jump.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace courant {
namespace {

std::string simplified(const std::string& text) {
  std::string out;
  for (unsigned char c : text)
    if (!std::isspace(c)) out += static_cast<char>(std::tolower(c));
  return out;
}

Real spacing(const std::vector<Real>& t) {
  return t.size() > 1 ? (t.back() - t.front()) / static_cast<Real>(t.size() - 1) : 0;
}

IntervalResult evaluate_interval(const Interval& interval, const JumpSeries& series, Real theory) {
  IntervalResult out;
  out.interval = interval;
  const Real slack = 0.25 * spacing(series.t);
  std::vector<Real> depth;
  for (std::size_t i = 0; i < series.t.size(); ++i)
    if (series.t[i] >= interval.from - slack && series.t[i] <= interval.to + slack)
      depth.push_back(series.depth[i]);
  out.states = static_cast<int>(depth.size());
  out.complete = !series.t.empty() && series.t.back() >= interval.to - 6 * slack &&
                 series.t.front() <= interval.from + 6 * slack;
  out.A = agreement_A(depth, theory);
  out.P = agreement_P(depth, theory);
  for (Real d : depth) out.mean_depth += d / static_cast<Real>(depth.size());
  return out;
}

Real value_at(const JumpSeries& s, const std::vector<Real>& values, Real t) {
  const auto nearest = std::min_element(s.t.begin(), s.t.end(),
                                        [&](Real a, Real b) { return std::abs(a - t) < std::abs(b - t); });
  return values[static_cast<std::size_t>(nearest - s.t.begin())];
}

std::string toe_text(const JumpRecipe& recipe, const JumpSeries& s) {
  std::string times = "  toe at t [s]    ", places = "         x [m]    ";
  const Real end = s.t.back();
  const Real step = end > 12 ? std::ceil(end / 10) : end > 2 ? 1 : end / 5;
  for (int k = 1; k * step <= end * (1 + 1e-3) && step > 0; ++k) {
    const Real toe = value_at(s, s.toe, k * step);
    times += fmt::format("{:8.3g}", k * step);
    places += std::isnan(toe) ? fmt::format("{:>8}", "-") : fmt::format("{:8.3f}", toe);
  }
  return fmt::format("Toe of the jump (most upstream depth > {:g} d1)\n{}\n{}\n", recipe.toe_threshold, times,
                     places);
}

}  // namespace

Real froude(Real v1, Real d1, Real g) {
  return v1 / std::sqrt(g * d1);
}

Real belanger_depth(Real v1, Real d1, Real g) {
  const Real Fr1 = froude(v1, d1, g);
  return 0.5 * d1 * (std::sqrt(1 + 8 * Fr1 * Fr1) - 1);
}

Real roller_length_over_d1(Real Fr1) {
  return 160 * std::tanh(Fr1 / 20) - 12;
}

Real velocity_decay(Real distance_over_d1) {
  return std::exp(-0.028 * distance_over_d1);
}

Real largest_deviation_over_d1(Real Fr1) {
  return 0.116 * std::pow(Fr1 - 1, 1.235);
}

Real surface_strouhal(Real Fr1) {
  return 0.143 * std::exp(-0.27 * Fr1);
}

Real agreement_A(std::span<const Real> depth, Real theory) {
  Real sum = 0;
  for (Real d : depth) sum += d * d;
  return std::sqrt(sum / (static_cast<Real>(depth.size()) * theory * theory));
}

Real agreement_P(std::span<const Real> depth, Real theory) {
  Real sum = 0;
  for (Real d : depth) sum += (d - theory) * (d - theory);
  return std::sqrt(sum / (static_cast<Real>(depth.size()) * theory * theory));
}

std::string find_case(const std::string& title, const std::vector<PublishedRow>& published) {
  const std::string text = simplified(title);
  for (const PublishedRow& row : published) {
    const std::string name = simplified(row.case_name);
    for (auto at = text.find(name); at != std::string::npos && !name.empty(); at = text.find(name, at + 1)) {
      const auto end = at + name.size();
      if (end == text.size() || !std::isdigit(static_cast<unsigned char>(text[end]))) return row.case_name;
    }
  }
  return {};
}

JumpResult evaluate_jump(const JumpRecipe& recipe, const std::string& case_name, JumpSeries series) {
  JumpResult out{.Fr1 = froude(recipe.v1, recipe.d1, recipe.g),
                 .d2_theory = belanger_depth(recipe.v1, recipe.d1, recipe.g),
                 .case_name = case_name,
                 .intervals = {},
                 .front_time = std::nullopt,
                 .turn = std::nullopt,
                 .series = std::move(series)};
  for (const Interval& interval : recipe.intervals) {
    IntervalResult result = evaluate_interval(interval, out.series, out.d2_theory);
    for (const PublishedRow& row : recipe.published) {
      const bool same_interval = row.interval.from == interval.from && row.interval.to == interval.to;
      if (same_interval && (case_name.empty() || simplified(row.case_name) == simplified(case_name)))
        result.published.push_back(row);
    }
    out.intervals.push_back(std::move(result));
  }
  for (std::size_t i = 0; i < out.series.front.size() && !out.front_time; ++i)
    if (out.series.front[i] > recipe.front_threshold * recipe.d1) out.front_time = out.series.t[i];
  for (std::size_t i = 0; i < out.series.toe.size(); ++i)
    if (!std::isnan(out.series.toe[i]) && (!out.turn || out.series.toe[i] > out.turn->second))
      out.turn = {out.series.t[i], out.series.toe[i]};
  return out;
}

std::string jump_text(const JumpRecipe& recipe, const JumpResult& result) {
  const JumpSeries& s = result.series;
  std::string out = fmt::format(
      "Depth at x = {:g} m against Belanger (eq. 1): d2 = {:.4f} m   (v1 = {:g} m/s, d1 = {:g} m, Fr1 = "
      "{:.2f})\n"
      "Case: {}; {} states from {:.3g} s to {:.3g} s\n"
      "  {:<18}{:>7}{:>12}{:>9}{:>9}   {:<24}{:>9}{:>9}\n",
      recipe.x, result.d2_theory, recipe.v1, recipe.d1, result.Fr1,
      result.case_name.empty() ? "unknown" : result.case_name, s.t.size(), s.t.front(), s.t.back(),
      "interval [s]", "states", "mean d2 [m]", "A", "P", "published", "A", "P");
  for (const IntervalResult& r : result.intervals) {
    const std::string name = fmt::format("{:g} - {:g}", r.interval.from, r.interval.to);
    std::string line = r.states == 0 ? fmt::format("  {:<18}{:>7}{:>12}{:>9}{:>9}", name, 0, "-", "-", "-")
                                     : fmt::format("  {:<18}{:>7}{:>12.4f}{:>9.3f}{:>9.3f}", name, r.states,
                                                   r.mean_depth, r.A, r.P);
    const std::string blank(line.size(), ' ');
    for (const PublishedRow& row : r.published) {
      out += fmt::format("{}   {:<24}{:>9.3f}{:>9.3f}\n", line, row.case_name, row.A, row.P);
      line = blank;
    }
    if (r.published.empty()) out += line + "\n";
    if (!r.complete)
      out += fmt::format("  {:<18}the results {} this interval\n", "",
                         r.states == 0 ? "do not reach" : "cover only a part of");
  }
  if (recipe.front_x)
    out += result.front_time
               ? fmt::format("The first wave passes x = {:g} m at t = {:.3f} s (depth > {:g} d1)\n",
                             *recipe.front_x, *result.front_time, recipe.front_threshold)
               : fmt::format("The wave does not reach x = {:g} m by t = {:.3g} s\n", *recipe.front_x,
                             s.t.back());
  if (!s.toe.empty()) out += toe_text(recipe, s);
  if (result.turn)
    out += fmt::format("The jump is furthest downstream at t = {:.3f} s, toe at x = {:.3f} m\n",
                       result.turn->first, result.turn->second);
  return out;
}

}  // namespace courant
