// kinds: grid and profile. Means and deviations of quantities on points, over the states that have water
// there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/file.hpp"
#include "post/field_sampler.hpp"

namespace courant {
namespace {

class GridAnalysis : public Analysis {
 public:
  GridAnalysis(const char* kind, const MapReader& map, const PostSettings& settings)
      : Analysis(kind, map), units_(settings.units), is_grid_(std::string_view(kind) == "grid") {
    map.allow({"kind", "name", "of", "where", "link", "share", "interpolation", "wet", "least_wet", "x", "y",
               "z", "from", "to", "states"});
    sampler_.read(map, units_);
    read_window(map, window_);
    map.number("least_wet", least_wet_);
    for (std::size_t a = 0; a < 3; ++a) {
      const char* key = a == 0 ? "x" : a == 1 ? "y" : "z";
      axes_[a] = read_places(map, key, a < 2);
      if (axes_[a].empty()) axes_[a] = {0};
      if (is_grid_) check_steps(map, key, axes_[a]);
    }
    constexpr std::size_t most = 5'000'000;
    if (axes_[0].size() * axes_[1].size() * axes_[2].size() > most) {
      map.error(map.node(), fmt::format("'{}' has more than {} points", map.name(), most));
      return;
    }
    for (Real z : axes_[2])
      for (Real y : axes_[1])
        for (Real x : axes_[0]) points_.push_back({x, y, z});
    moments_.assign(sampler_.of.size(), std::vector<RunningMoments>(points_.size()));
    wet_.assign(points_.size(), 0);
    colour_.assign(points_.size(), 0);
    if (const auto node = map.get("states", false)) {
      if (!is_grid_ || !node->IsScalar() || !YAML::convert<bool>::decode(*node, states_))
        map.error(*node, fmt::format("'{}.states' must be true or false, and of a grid", map.name()));
    }
  }

  void note_needs(std::vector<ParticleArray>& arrays) const override { sampler_.note_needs(arrays); }
  bool looks_at(Real t, Real slack) const override { return window_.holds(t, slack); }

  void take(const PostState& state) override {
    const FieldSampler::Sample sample = sampler_.sample(state, points_);
    times_.push_back(state.frame.t);
    for (std::size_t p = 0; p < points_.size(); ++p)
      wet_[p] += sample.wet[p] != 0, colour_[p] += sample.colour[p];
    for (std::size_t q = 0; q < sampler_.of.size(); ++q)
      for (std::size_t p = 0; p < points_.size(); ++p) moments_[q][p].add(sample.values[q][p]);
    fallbacks_ += sample.fallbacks;
    if (states_) write_state(state, sample);
  }

  void finish(const std::vector<std::unique_ptr<Analysis>>&, const std::filesystem::path&,
              Diagnostics& diagnostics) override {
    if (times_.empty()) return fault_no_state(diagnostics);
    const Real states = static_cast<Real>(times_.size());
    PostTable& table = add_table();
    const std::string length = units_.of({0, 1, 0});
    for (std::size_t a = 0; a < 3; ++a)
      if (a < 2 || axes_[2].size() > 1) {
        std::vector<Real> place;
        for (const Point& point : points_) place.push_back(point[a]);
        table.columns.push_back({a == 0 ? "x" : a == 1 ? "y" : "z", length, std::move(place)});
      }
    std::vector<Real> wet(points_.size());
    for (std::size_t p = 0; p < points_.size(); ++p) wet[p] = wet_[p] / states;
    for (std::size_t q = 0; q < sampler_.of.size(); ++q) {
      std::vector<Real> mean(points_.size(), std::nan("")), deviation = mean;
      for (std::size_t p = 0; p < points_.size(); ++p)
        if (wet[p] >= least_wet_)
          mean[p] = moments_[q][p].mean_or_nan(), deviation[p] = moments_[q][p].deviation();
      table.columns.push_back({sampler_.of[q].name + "_mean", sampler_.of[q].unit, std::move(mean)});
      table.columns.push_back(
          {sampler_.of[q].name + "_deviation", sampler_.of[q].unit, std::move(deviation)});
    }
    table.columns.push_back({"wet", "-", std::move(wet)});
    for (Real& colour : colour_) colour /= states;
    table.columns.push_back({"colour", "-", std::move(colour_)});
    result_.text +=
        fmt::format("  {} x {} x {} points, mean of {} states from t = {:.4g} to {:.4g}\n", axes_[0].size(),
                    axes_[1].size(), axes_[2].size(), times_.size(), times_.front(), times_.back());
    add_scalar("states", "-", states);
    if (fallbacks_ > 0) {
      add_scalar("mls_fallbacks", "-", static_cast<Real>(fallbacks_));
      result_.text += fmt::format("  {} of {} values by Shepard where MLS was not possible\n", fallbacks_,
                                  static_cast<std::size_t>(states) * points_.size());
    }
    if (is_grid_) add_image(table);
    if (states_) write_file(folder_ / (name() + ".pvd"), pvd_ + "</Collection>\n</VTKFile>\n");
  }

 private:
  static void check_steps(const MapReader& map, const char* key, const std::vector<Real>& axis) {
    const auto node = map.get(key, false);
    if (node && axis.size() > 1 && !node->IsMap())
      map.error(*node,
                fmt::format("'{}.{}' of a grid must be {{from, to, step}} or one number", map.name(), key));
  }

  PostImage image(const std::string& name) const {
    PostImage out;
    out.name = name;
    for (std::size_t a = 0; a < 3; ++a) {
      out.n[a] = static_cast<int>(axes_[a].size());
      out.origin[a] = axes_[a].front();
      if (axes_[a].size() > 1) out.spacing[a] = axes_[a][1] - axes_[a][0];
    }
    return out;
  }

  void add_image(const PostTable& table) {
    PostImage mean = image(name());
    mean.t = times_.back();
    for (const PostColumn& column : table.columns)
      if (column.name != "x" && column.name != "y" && column.name != "z") mean.fields.push_back(column);
    result_.images.push_back(std::move(mean));
  }

  void write_state(const PostState& state, const FieldSampler::Sample& sample) {
    PostImage now = image(fmt::format("{}_{:04}", name(), times_.size() - 1));
    now.t = state.frame.t;
    for (std::size_t q = 0; q < sampler_.of.size(); ++q)
      now.fields.push_back({sampler_.of[q].name, sampler_.of[q].unit, sample.values[q]});
    now.fields.push_back({"wet", "-", std::vector<Real>(sample.wet.begin(), sample.wet.end())});
    folder_ = state.folder;
    make_folder(folder_ / name());
    write_vti(state.folder / name() / (now.name + ".vti"), now);
    pvd_ += fmt::format("<DataSet timestep=\"{:.9g}\" part=\"0\" file=\"{}/{}.vti\"/>\n", now.t, name(),
                        now.name);
  }

  PostUnits units_;
  bool is_grid_, states_ = false;
  FieldSampler sampler_;
  TimeWindow window_;
  Real least_wet_ = 0.5;  // share of the states that must have water at a point
  std::array<std::vector<Real>, 3> axes_;
  std::vector<Point> points_;                         // x fastest
  std::vector<std::vector<RunningMoments>> moments_;  // shape: (of, points)
  std::vector<Real> wet_, colour_;                    // states with water there; sum of C over states
  std::size_t fallbacks_ = 0;
  std::filesystem::path folder_;
  std::string pvd_ = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
};

}  // namespace

std::unique_ptr<Analysis> read_grid_analysis(const MapReader& map, const PostSettings& settings) {
  return std::make_unique<GridAnalysis>("grid", map, settings);
}

std::unique_ptr<Analysis> read_profile_analysis(const MapReader& map, const PostSettings& settings) {
  return std::make_unique<GridAnalysis>("profile", map, settings);
}

}  // namespace courant
