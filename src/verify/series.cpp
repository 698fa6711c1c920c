#include "verify/series.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

Series window(const Series& series, Real from, Real to) {
  Series out;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (series.x[i] < from || series.x[i] > to) continue;
    out.x.push_back(series.x[i]);
    out.y.push_back(series.y[i]);
  }
  return out;
}

std::optional<Real> value_at(const Series& s, Real x) {
  if (s.size() == 0) return std::nullopt;
  const Real slack = 1e-6 * (s.x.back() - s.x.front());
  if (x < s.x.front() - slack || x > s.x.back() + slack) return std::nullopt;
  const auto above = std::lower_bound(s.x.begin(), s.x.end(), x);
  if (above == s.x.begin()) return s.y.front();
  if (above == s.x.end()) return s.y.back();
  const auto i = static_cast<std::size_t>(above - s.x.begin());
  const Real share = (x - s.x[i - 1]) / (s.x[i] - s.x[i - 1]);
  return s.y[i - 1] + share * (s.y[i] - s.y[i - 1]);
}

std::optional<Real> slope_of(const std::vector<Real>& x, const std::vector<Real>& y) {
  if (x.size() < 2) return std::nullopt;
  const Real n = static_cast<Real>(x.size());
  Real mx = 0, my = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i)
    sxx += (x[i] - mx) * (x[i] - mx), sxy += (x[i] - mx) * (y[i] - my);
  if (!(sxx > 0)) return std::nullopt;
  return sxy / sxx;
}

Real norm_of(const std::vector<Real>& values, const std::string& norm) {
  Real sum = 0, largest = 0;
  for (const Real v : values) {
    sum += norm == "l1" ? std::abs(v) : v * v;
    largest = std::max(largest, std::abs(v));
  }
  if (norm == "linf") return largest;
  const Real mean = sum / static_cast<Real>(values.size());
  return norm == "l1" ? mean : std::sqrt(mean);
}

Series thinned(const Series& series, std::size_t most) {
  if (series.size() <= most) return series;
  Series out;
  for (std::size_t k = 0; k < most; ++k) {
    const std::size_t i = k * (series.size() - 1) / (most - 1);
    out.x.push_back(series.x[i]);
    out.y.push_back(series.y[i]);
  }
  return out;
}

Taken take_number(const Series& s, const std::string& take, std::optional<Real> at) {
  if (s.size() == 0) return {std::nullopt, "the window holds no sample"};
  if (take == "final") return {s.y.back(), {}};
  if (take == "min") return {*std::min_element(s.y.begin(), s.y.end()), {}};
  if (take == "max") return {*std::max_element(s.y.begin(), s.y.end()), {}};
  if (take == "period") return period_of(s);
  if (take == "decay") return decay_of(s);
  if (take == "mean") {
    Real sum = 0;
    for (const Real y : s.y) sum += y;
    return {sum / static_cast<Real>(s.size()), {}};
  }
  if (take == "at") {
    const auto value = at ? value_at(s, *at) : std::nullopt;
    return {value, value ? "" : "the moment lies outside the samples"};
  }
  if (take == "slope") {
    const auto value = slope_of(s.x, s.y);
    return {value, value ? "" : "a slope needs two samples"};
  }
  if (take == "growth") {
    if (s.y.front() == 0) return {std::nullopt, "growth needs a first value that is not 0"};
    return {*std::max_element(s.y.begin(), s.y.end()) / s.y.front(), {}};
  }
  return {std::nullopt, "not a number"};
}

}  // namespace courant
