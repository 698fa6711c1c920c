// kind: probe. Quantities at points over time.
#include <fmt/format.h>

#include "post/field_sampler.hpp"

namespace courant {
namespace {

class ProbeAnalysis : public Analysis {
 public:
  ProbeAnalysis(const MapReader& map, const PostSettings& settings)
      : Analysis("probe", map), units_(settings.units) {
    map.allow({"kind", "name", "of", "where", "link", "share", "interpolation", "wet", "at", "from", "to"});
    sampler_.read(map, units_);
    read_window(map, window_);
    map.list(
        "at", [&](const YAML::Node& node) { add_point(map, node); }, true);
    columns_.resize(sampler_.of.size() * points_.size());
    moments_.resize(columns_.size());
  }

  void note_needs(std::vector<ParticleArray>& arrays) const override { sampler_.note_needs(arrays); }

  void take(const PostState& state) override {
    const FieldSampler::Sample sample = sampler_.sample(state, points_);
    times_.push_back(state.frame.t);
    for (std::size_t p = 0; p < points_.size(); ++p)
      for (std::size_t q = 0; q < sampler_.of.size(); ++q) {
        const std::size_t c = p * sampler_.of.size() + q;
        columns_[c].push_back(sample.values[q][p]);
        if (window_.holds(state.frame.t, state.slack))
          moments_[c].add(sample.values[q][p]), window_states_ += c == 0;
      }
    fallbacks_ += sample.fallbacks;
  }

  std::vector<PostSeries> series() const override {
    std::vector<PostSeries> out;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::size_t p = c / sampler_.of.size(), q = c % sampler_.of.size();
      out.push_back({column_name(p, q), sampler_.of[q].unit, points_[p][0], columns_[c]});
    }
    return out;
  }

  void finish(const std::vector<std::unique_ptr<Analysis>>&, const std::filesystem::path&,
              Diagnostics& diagnostics) override {
    if (window_states_ == 0) return fault_no_state(diagnostics);
    PostTable& table = add_table();
    table.columns.push_back({"t", units_.of({0, 0, 1}), times_});
    for (PostSeries& one : series()) table.columns.push_back({one.name, one.unit, std::move(one.values)});
    result_.text += fmt::format("  {} points, {} states; means over {} states\n", points_.size(),
                                times_.size(), window_states_);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::size_t p = c / sampler_.of.size(), q = c % sampler_.of.size();
      add_scalar(column_name(p, q) + "_mean", sampler_.of[q].unit, moments_[c].mean_or_nan());
      add_scalar(column_name(p, q) + "_deviation", sampler_.of[q].unit, moments_[c].deviation());
    }
    if (fallbacks_ > 0) add_scalar("mls_fallbacks", "-", static_cast<Real>(fallbacks_));
  }

 private:
  void add_point(const MapReader& map, const YAML::Node& node) {
    if (!node.IsSequence() || node.size() < 2 || node.size() > 3)
      return map.error(node, fmt::format("'{}.at': a point has two or three coordinates", map.name()),
                       "for example [[0.5, 0.02], [0.6, 0.02]]");
    Point point{};
    for (std::size_t a = 0; a < node.size(); ++a) map.scalar(node[a], "at", point[a]);
    points_.push_back(point);
  }
  std::string column_name(std::size_t p, std::size_t q) const {
    return points_.size() == 1 ? sampler_.of[q].name : fmt::format("{}_{}", sampler_.of[q].name, p + 1);
  }

  PostUnits units_;
  FieldSampler sampler_;
  TimeWindow window_;
  std::vector<Point> points_;
  std::vector<std::vector<Real>> columns_;  // shape: (points x of, states)
  std::vector<RunningMoments> moments_;
  std::size_t fallbacks_ = 0, window_states_ = 0;
};

}  // namespace

std::unique_ptr<Analysis> read_probe_analysis(const MapReader& map, const PostSettings& settings) {
  return std::make_unique<ProbeAnalysis>(map, settings);
}

}  // namespace courant
