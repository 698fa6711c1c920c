// kind: toe. Where the surface first rises over a threshold, over time.
#include <fmt/format.h>

#include <cmath>

#include "post/analysis.hpp"

namespace courant {
namespace {

class ToeAnalysis : public Analysis {
 public:
  ToeAnalysis(const MapReader& map, const PostSettings& settings)
      : Analysis("toe", map), units_(settings.units) {
    map.allow({"kind", "name", "of", "depth", "x", "from", "to"});
    map.text("of", of_, true);
    map.positive("depth", depth_, true);
    if (const auto x = read_range(map, "x")) x_ = *x;
    read_window(map, window_);
  }

  bool needs_states() const override { return false; }
  std::vector<std::pair<const char*, std::string>> refers() const override { return {{"of", of_}}; }
  std::vector<PostSeries> series() const override {
    return {{"toe", units_.of({0, 1, 0}), std::nullopt, toe_}};
  }

  void finish(const std::vector<std::unique_ptr<Analysis>>& earlier, const std::filesystem::path&,
              Diagnostics& diagnostics) override {
    const Analysis* source = find_analysis(earlier, of_, *this, diagnostics);
    if (!source) return;
    if (source->kind() != "surface")
      return fault(diagnostics, fmt::format("'{}' is no surface but a {}", of_, source->kind()));
    const std::vector<PostSeries> depths = source->series();
    if (!window_.holds_any(source->times())) return fault_no_state(diagnostics);
    times_ = source->times();
    for (std::size_t i = 0; i < times_.size(); ++i) toe_.push_back(toe_at(depths, i));
    write();
  }

 private:
  /// The crossing of the threshold, linear between the places of the surface; NaN: nowhere.
  Real toe_at(const std::vector<PostSeries>& depths, std::size_t state) const {
    const PostSeries* before = nullptr;
    for (const PostSeries& here : depths) {
      const Real x = here.x.value_or(0);
      if (x < x_.first || x > x_.second) continue;
      if (here.values[state] > depth_) {
        if (!before) return x;
        const Real a = before->values[state], b = here.values[state];
        return *before->x + (depth_ - a) / (b - a) * (x - *before->x);
      }
      before = &here;
    }
    return std::nan("");
  }

  void write() {
    const std::string length = units_.of({0, 1, 0}), time = units_.of({0, 0, 1}),
                      speed = units_.of({0, 1, -1});
    add_table().columns = {{"t", time, times_}, {"toe", length, toe_}};
    const Real slack = slack_of(times_);
    RunningMoments x, t;
    for (std::size_t i = 0; i < times_.size(); ++i)
      if (window_.holds(times_[i], slack) && !std::isnan(toe_[i])) x.add(toe_[i]), t.add(times_[i]);
    Real product = 0;
    for (std::size_t i = 0; i < times_.size(); ++i)
      if (window_.holds(times_[i], slack) && !std::isnan(toe_[i]))
        product += (toe_[i] - x.mean) * (times_[i] - t.mean);
    const Real slope = t.squares > 0 ? product / t.squares : std::nan("");
    add_scalar("toe_mean", length, x.mean_or_nan());
    add_scalar("toe_deviation", length, x.deviation());
    add_scalar("toe_speed", speed, slope);
    result_.text +=
        fmt::format("  toe (depth over {:g} {}): mean x = {:.4g} {}, deviation {:.3g}, drift {:.3g} {}\n",
                    depth_, length, x.mean_or_nan(), length, x.deviation(), slope, speed);
  }

  PostUnits units_;
  std::string of_;
  Real depth_ = 0;
  std::pair<Real, Real> x_{-std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::infinity()};
  TimeWindow window_;
  std::vector<Real> toe_;
};

}  // namespace

std::unique_ptr<Analysis> read_toe_analysis(const MapReader& map, const PostSettings& settings) {
  return std::make_unique<ToeAnalysis>(map, settings);
}

}  // namespace courant
