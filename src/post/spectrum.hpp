#pragma once
// Power spectra of series over time.
#include <optional>
#include <utility>
#include <vector>

#include "base/real.hpp"

namespace courant {

enum class SpectrumWindow { hann, rectangle };
enum class Detrend { linear, mean };

struct SpectrumSettings {
  Real segment = 0;    ///< length of a segment [T]
  Real overlap = 0.5;  ///< share of a segment that the next one repeats
  SpectrumWindow window = SpectrumWindow::hann;
  Detrend detrend = Detrend::linear;
};

/// One-sided power spectral density; its integral over the frequency is the variance of the segments.
struct Spectrum {
  std::vector<Real> frequency;  ///< k / segment, k = 0 ... n/2 [1/T]
  std::vector<Real> density;    ///< [unit^2 T]
  int segments = 0;
  /// Frequency of the largest density within a band, refined by a parabola through the logarithms of its
  /// neighbours; none if all densities there are 0. The band leaves out f = 0. [1/T]
  std::optional<Real> dominant(Real low, Real high) const;
  Real variance(Real low, Real high) const;  ///< integral of the density over the bins in a band
};

/// Welch's method: segments that overlap, each without its trend, times a window; mean of their periodograms.
/// values: (n), dt apart. Segments longer than the series are shortened to it. n must be at least 4. Source:
/// Welch, IEEE Trans. Audio Electroacoust. 15 (1967).
Spectrum welch(const std::vector<Real>& values, Real dt, const SpectrumSettings& settings);

/// Values at equal steps between t.front() and t.back(), linear between neighbours; NaN are left out. Nothing
/// if fewer than four numbers are there or a gap is longer than `longest_gap` [T].
std::optional<std::vector<Real>> at_equal_steps(const std::vector<Real>& t, const std::vector<Real>& values,
                                                Real longest_gap);

}  // namespace courant
