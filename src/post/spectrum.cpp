#include "post/spectrum.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace courant {
namespace {

/// Takes the mean or the straight line of least squares away.
void remove_trend(Real* values, std::size_t n, Detrend detrend) {
  const Real middle = 0.5 * static_cast<Real>(n - 1);
  Real mean = 0, slope = 0, square = 0;
  for (std::size_t i = 0; i < n; ++i) mean += values[i] / static_cast<Real>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Real s = static_cast<Real>(i) - middle;
    slope += s * values[i], square += s * s;
  }
  slope = detrend == Detrend::linear ? slope / square : 0;
  for (std::size_t i = 0; i < n; ++i) values[i] -= mean + slope * (static_cast<Real>(i) - middle);
}

/// A real transform of length n, planned once.
class Transform {
 public:
  explicit Transform(std::size_t n)
      : n_(n),
        in_(fftw_alloc_real(n)),
        out_(fftw_alloc_complex(n / 2 + 1)),
        plan_(fftw_plan_dft_r2c_1d(static_cast<int>(n), in_, out_, FFTW_ESTIMATE)) {}
  Transform(const Transform&) = delete;
  Transform& operator=(const Transform&) = delete;
  ~Transform() {
    fftw_destroy_plan(plan_);
    fftw_free(out_);
    fftw_free(in_);
  }
  Real* input() { return in_; }
  /// |X_k|^2
  void add_squares(std::vector<Real>& to) {
    fftw_execute(plan_);
    for (std::size_t k = 0; k <= n_ / 2; ++k) to[k] += out_[k][0] * out_[k][0] + out_[k][1] * out_[k][1];
  }

 private:
  std::size_t n_;
  double* in_;
  fftw_complex* out_;
  fftw_plan plan_;
};

}  // namespace

Spectrum welch(const std::vector<Real>& values, Real dt, const SpectrumSettings& settings) {
  const auto wanted = static_cast<std::size_t>(std::lround(settings.segment / dt));
  const std::size_t n = std::clamp<std::size_t>(wanted, 4, values.size());
  const auto step = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround((1 - settings.overlap) * static_cast<Real>(n))));
  std::vector<Real> window(n, 1);
  if (settings.window == SpectrumWindow::hann)
    for (std::size_t i = 0; i < n; ++i)
      window[i] = 0.5 - 0.5 * std::cos(2 * pi * static_cast<Real>(i) / static_cast<Real>(n));
  Real power = 0;
  for (Real w : window) power += w * w;

  Spectrum out;
  out.density.assign(n / 2 + 1, 0);
  Transform transform(n);
  for (std::size_t start = 0; start + n <= values.size(); start += step, ++out.segments) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(start), n, transform.input());
    remove_trend(transform.input(), n, settings.detrend);
    for (std::size_t i = 0; i < n; ++i) transform.input()[i] *= window[i];
    transform.add_squares(out.density);
  }
  for (std::size_t k = 0; k <= n / 2; ++k) {
    const bool alone = k == 0 || 2 * k == n;  // all others stand for -f, too
    out.density[k] *= (alone ? 1 : 2) * dt / (power * out.segments);
    out.frequency.push_back(static_cast<Real>(k) / (static_cast<Real>(n) * dt));
  }
  return out;
}

std::optional<Real> Spectrum::dominant(Real low, Real high) const {
  std::size_t best = 0;
  for (std::size_t k = 1; k < density.size(); ++k)
    if (frequency[k] >= low && frequency[k] <= high && density[k] > (best ? density[best] : 0)) best = k;
  if (best == 0) return std::nullopt;
  const Real df = frequency[1];
  if (best < 2 || best + 1 >= density.size() || !(density[best - 1] > 0) || !(density[best + 1] > 0))
    return frequency[best];
  const Real a = std::log(density[best - 1]), b = std::log(density[best]), c = std::log(density[best + 1]);
  const Real curvature = a - 2 * b + c;
  // a band may end beside the top of its slope: then there is no top to refine
  if (!(curvature < 0) || a > b || c > b) return frequency[best];
  return frequency[best] + 0.5 * (a - c) / curvature * df;
}

Real Spectrum::variance(Real low, Real high) const {
  Real sum = 0;
  for (std::size_t k = 1; k < density.size(); ++k)
    if (frequency[k] >= low && frequency[k] <= high) sum += density[k] * frequency[1];
  return sum;
}

std::optional<std::vector<Real>> at_equal_steps(const std::vector<Real>& t, const std::vector<Real>& values,
                                                Real longest_gap) {
  std::vector<std::size_t> there;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (!std::isnan(values[i])) there.push_back(i);
  if (there.size() < 4 || t[there.front()] - t.front() > longest_gap ||
      t.back() - t[there.back()] > longest_gap)
    return std::nullopt;
  for (std::size_t k = 1; k < there.size(); ++k)
    if (t[there[k]] - t[there[k - 1]] > longest_gap) return std::nullopt;
  const Real dt = (t.back() - t.front()) / static_cast<Real>(t.size() - 1);
  std::vector<Real> out;
  std::size_t k = 1;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Real at = t.front() + static_cast<Real>(i) * dt;
    while (k + 1 < there.size() && t[there[k]] < at) ++k;
    const Real a = t[there[k - 1]], b = t[there[k]];
    const Real share = b > a ? std::clamp<Real>((at - a) / (b - a), 0, 1) : 1;
    out.push_back((1 - share) * values[there[k - 1]] + share * values[there[k]]);
  }
  return out;
}

}  // namespace courant
