// kind: spectrum. Power spectra of the series of another analysis.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "post/analysis.hpp"
#include "post/spectrum.hpp"

namespace courant {
namespace {

class SpectrumAnalysis : public Analysis {
 public:
  SpectrumAnalysis(const MapReader& map, const PostSettings& settings)
      : Analysis("spectrum", map), units_(settings.units) {
    map.allow({"kind", "name", "of", "from", "to", "segment", "overlap", "window", "detrend", "band"});
    map.text("of", of_, true);
    read_window(map, window_);
    map.positive("segment", settings_.segment);
    map.number("overlap", settings_.overlap);
    if (!(settings_.overlap >= 0 && settings_.overlap < 0.95))
      map.error(*map.get("overlap", false),
                fmt::format("'{}.overlap' must be 0 to 0.95, got {:g}", map.name(), settings_.overlap));
    settings_.window = read_choice(map, "window", {"hann", "rectangle"}) == 0 ? SpectrumWindow::hann
                                                                              : SpectrumWindow::rectangle;
    settings_.detrend =
        read_choice(map, "detrend", {"linear", "mean"}) == 0 ? Detrend::linear : Detrend::mean;
    if (const auto band = read_range(map, "band")) band_ = *band;
  }

  bool needs_states() const override { return false; }
  std::vector<std::pair<const char*, std::string>> refers() const override { return {{"of", of_}}; }

  void finish(const std::vector<std::unique_ptr<Analysis>>& earlier, const std::filesystem::path&,
              Diagnostics& diagnostics) override {
    const Analysis* source = find_analysis(earlier, of_, *this, diagnostics);
    if (!source) return;
    const std::vector<PostSeries> series = source->series();
    if (series.empty())
      return fault(diagnostics, fmt::format("'{}' has no series over time", of_),
                   "probe, surface, flux, history, force and toe have");
    if (!find_window(source->times(), diagnostics)) return;
    for (const PostSeries& one : series) add_series(one, diagnostics);
    if (densities_.empty()) return fault(diagnostics, fmt::format("no series of '{}' is without gaps", of_));
    const bool alike = std::all_of(densities_.begin(), densities_.end(),
                                   [&](const PostColumn& c) { return c.unit == densities_.front().unit; });
    if (!alike)
      diagnostics.warning(
          where(), fmt::format("analysis '{}': the series of '{}' have different units: they have no mean",
                               name(), of_));
    write_tables(series, alike);
  }

 private:
  bool find_window(const std::vector<Real>& times, Diagnostics& diagnostics) {
    const Real slack = slack_of(times);
    first_ = times.size(), end_ = 0;
    for (std::size_t i = 0; i < times.size(); ++i)
      if (window_.holds(times[i], slack)) first_ = std::min(first_, i), end_ = i + 1;
    if (end_ < first_ + 8) {
      fault(diagnostics, "fewer than eight states are in its window in time");
      return false;
    }
    t_.assign(times.begin() + static_cast<std::ptrdiff_t>(first_),
              times.begin() + static_cast<std::ptrdiff_t>(end_));
    dt_ = (t_.back() - t_.front()) / static_cast<Real>(t_.size() - 1);
    if (settings_.segment <= 0) settings_.segment = 0.25 * (t_.back() - t_.front());
    return true;
  }

  void add_series(const PostSeries& series, Diagnostics& diagnostics) {
    const std::vector<Real> part(series.values.begin() + static_cast<std::ptrdiff_t>(first_),
                                 series.values.begin() + static_cast<std::ptrdiff_t>(end_));
    constexpr Real longest_gap = 10;  // steps
    const auto values = at_equal_steps(t_, part, longest_gap * dt_);
    if (!values) {
      diagnostics.warning(where(),
                          fmt::format("analysis '{}': the series {} of '{}' has a gap of more than {:g} "
                                      "states and is left out",
                                      name(), series.name, of_, longest_gap));
      return;
    }
    const Spectrum spectrum = welch(*values, dt_, settings_);
    frequency_ = spectrum.frequency;
    segments_ = spectrum.segments;
    densities_.push_back({series.name, fmt::format("({})2 {}", series.unit, units_.time), spectrum.density});
    places_.push_back(series.x.value_or(std::nan("")));
    const auto peak = spectrum.dominant(band_.first, band_.second);
    peaks_.push_back(peak.value_or(std::nan("")));
    const Real all = spectrum.variance(0, spectrum.frequency.back());
    deviations_.push_back(std::sqrt(all));
    shares_.push_back(all > 0 ? spectrum.variance(band_.first, band_.second) / all : std::nan(""));
    const auto [low, high] = band_;
    Real top = 0;
    for (std::size_t k = 1; k < spectrum.density.size(); ++k)
      if (spectrum.frequency[k] >= low && spectrum.frequency[k] <= high)
        top = std::max(top, spectrum.density[k]);
    tops_.push_back(top);
    unit_ = series.unit;
  }

  /// `alike`: the series have one unit.
  void write_tables(const std::vector<PostSeries>& series, bool alike) {
    const std::string hertz = units_.of({0, 0, -1}), length = units_.of({0, 1, 0});
    PostTable& main = add_table();
    main.columns.push_back({"f", hertz, frequency_});
    std::vector<Real> mean(frequency_.size(), alike ? 0 : std::nan(""));
    for (const PostColumn& one : densities_)
      for (std::size_t k = 0; k < mean.size(); ++k)
        mean[k] += one.values[k] / static_cast<Real>(densities_.size());
    Spectrum over_all;
    over_all.frequency = frequency_, over_all.density = mean;
    main.columns.push_back({"mean", alike ? densities_.front().unit : "?", mean});
    for (PostColumn& one : densities_) main.columns.push_back(std::move(one));
    const std::string unit = main.columns[1].unit;
    std::vector<Real> number;
    for (std::size_t i = 0; i < places_.size(); ++i) number.push_back(static_cast<Real>(i + 1));
    add_table("peaks").columns = {{"number", "-", number},
                                  {"x", length, places_},
                                  {"f", hertz, peaks_},
                                  {"density", unit, tops_},
                                  {"deviation", alike ? unit_ : "?", deviations_},
                                  {"share_in_band", "-", shares_}};
    const Real dominant = over_all.dominant(band_.first, band_.second).value_or(std::nan(""));
    const Real df = frequency_[1];
    add_scalar("resolution", hertz, df);
    add_scalar("segments", "-", segments_);
    add_scalar("dominant_of_mean", hertz, dominant);
    add_scalar("dominant_median", hertz, median(peaks_));
    result_.text += fmt::format(
        "  {} of {} series, t = {:.4g} to {:.4g}, {} segments of {:.4g} {}, {} window, overlap {:g}: "
        "resolution {:.3g} "
        "{}\n  dominant frequency: {:.3g} {} of the mean spectrum, {:.3g} {} in the median of the series\n",
        places_.size(), series.size(), t_.front(), t_.back(), segments_, 1 / df, units_.time,
        settings_.window == SpectrumWindow::hann ? "Hann" : "rectangular", settings_.overlap, df, hertz,
        dominant, hertz, median(peaks_), hertz);
  }

  PostUnits units_;
  std::string of_, unit_;
  TimeWindow window_;
  SpectrumSettings settings_;
  std::pair<Real, Real> band_{0, std::numeric_limits<Real>::infinity()};
  std::size_t first_ = 0, end_ = 0;
  Real dt_ = 0;
  int segments_ = 0;
  std::vector<Real> t_, frequency_, places_, peaks_, tops_, deviations_, shares_;
  std::vector<PostColumn> densities_;
};

}  // namespace

std::unique_ptr<Analysis> read_spectrum_analysis(const MapReader& map, const PostSettings& settings) {
  return std::make_unique<SpectrumAnalysis>(map, settings);
}

}  // namespace courant
