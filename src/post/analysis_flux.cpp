// kind: flux. What flows through planes across an axis.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "post/analysis.hpp"

namespace courant {
namespace {

/// Cubic spline in one dimension, support 2h, integral 1. [1/L]
Real slab_weight(Real distance, Real h) {
  const Real q = std::abs(distance) / h, norm = 2 / (3 * h);
  if (q >= 2) return 0;
  return norm * (q < 1 ? 1 - 1.5 * q * q + 0.75 * q * q * q : 0.25 * (2 - q) * (2 - q) * (2 - q));
}

constexpr std::size_t columns_per_plane = 9;
constexpr std::array<const char*, columns_per_plane> column_names{
    "mass",           "volume",  "momentum_x", "momentum_y",   "momentum_z",
    "pressure_force", "kinetic", "potential",  "pressure_work"};

class FluxAnalysis : public Analysis {
 public:
  FluxAnalysis(const MapReader& map, const PostSettings& settings)
      : Analysis("flux", map), units_(settings.units), up_(settings.up) {
    map.allow({"kind", "name", "where", "normal", "at", "x", "y", "z", "g", "level", "from", "to"});
    where_ = read_where(map);
    normal_ = read_choice(map, "normal", {"x", "y", "z"});
    at_ = read_places(map, "at", true);
    for (std::size_t a = 0; a < 3; ++a) {
      const char* key = a == 0 ? "x" : a == 1 ? "y" : "z";
      extent_[a] = read_range(map, key);
      if (extent_[a] && a == normal_)
        map.error(*map.get(key, false), fmt::format("'{}.{}' is the normal of the planes", map.name(), key),
                  "extents bound the planes along the other axes");
    }
    map.number("g", g_);
    map.number("level", level_);
    read_window(map, window_);
    columns_.resize(at_.size() * columns_per_plane);
    moments_.resize(columns_.size());
  }

  void note_needs(std::vector<ParticleArray>& arrays) const override {
    note_arrays(where_.of, arrays);
    note_arrays(CompiledExpression("vx + p + m", quantity_variables()), arrays);
  }

  void take(const PostState& state) override {
    const ParticleFrame& f = state.frame;
    const std::vector<Real>&v = f.arrays.at("velocity"), &p = f.arrays.at("pressure"),
          &m = f.arrays.at("mass");
    dim_ = f.dim;
    times_.push_back(f.t);
    const bool in_window = window_.holds(f.t, state.slack);
    window_states_ += in_window;
    const ParticleGrid& particles = state.selection(where_.text, where_.of);
    for (std::size_t plane = 0; plane < at_.size(); ++plane) {
      std::array<Real, columns_per_plane> sum{};
      for (const ParticleGrid::Particle& one : particles.particles()) {
        const Real w = slab_weight(one.x[normal_] - at_[plane], one.h);
        if (w == 0 || !within(one.x)) continue;
        const std::size_t i = one.row;
        const Real* u = &v[3 * i];
        const Real mass = m[i] * w * u[normal_], volume = one.V * w * u[normal_];
        const Real add[] = {mass,
                            volume,
                            mass * u[0],
                            mass * u[1],
                            mass * u[2],
                            one.V * w * p[i],
                            0.5 * mass * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]),
                            mass * g_ * (one.x[up_] - level_),
                            volume * p[i]};
        for (std::size_t c = 0; c < columns_per_plane; ++c) sum[c] += add[c];
      }
      for (std::size_t c = 0; c < columns_per_plane; ++c) {
        columns_[plane * columns_per_plane + c].push_back(sum[c]);
        if (in_window) moments_[plane * columns_per_plane + c].add(sum[c]);
      }
    }
  }

  std::vector<PostSeries> series() const override {
    std::vector<PostSeries> out;
    for (std::size_t plane = 0; plane < at_.size(); ++plane)
      for (std::size_t c = 0; c < columns_per_plane; ++c)
        out.push_back({at_.size() == 1 ? column_names[c]
                                       : fmt::format("{}@{}", column_names[c], short_number(at_[plane])),
                       unit(c), at_[plane], columns_[plane * columns_per_plane + c]});
    return out;
  }

  void finish(const std::vector<std::unique_ptr<Analysis>>&, const std::filesystem::path&,
              Diagnostics& diagnostics) override {
    if (window_states_ == 0) return fault_no_state(diagnostics);
    PostTable& over_time = add_table();
    over_time.columns.push_back({"t", units_.of({0, 0, 1}), times_});
    for (PostSeries& one : series()) over_time.columns.push_back({one.name, one.unit, std::move(one.values)});
    PostTable& mean = add_table("mean");
    mean.columns.push_back({"at", units_.of({0, 1, 0}), at_});
    for (std::size_t c = 0; c < columns_per_plane; ++c) {
      PostColumn means{std::string(column_names[c]) + "_mean", unit(c), {}},
          deviations{std::string(column_names[c]) + "_deviation", unit(c), {}};
      for (std::size_t plane = 0; plane < at_.size(); ++plane) {
        means.values.push_back(moments_[plane * columns_per_plane + c].mean);
        deviations.values.push_back(moments_[plane * columns_per_plane + c].deviation());
      }
      mean.columns.push_back(std::move(means));
      mean.columns.push_back(std::move(deviations));
    }
    for (std::size_t plane = 0; plane < at_.size(); ++plane)
      result_.text += fmt::format("  at {:g}: mass {:.5g} {}, mean of {} states\n", at_[plane],
                                  moments_[plane * columns_per_plane].mean, unit(0), window_states_);
  }

 private:
  bool within(const Point& x) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (extent_[a] && (x[a] < extent_[a]->first || x[a] > extent_[a]->second)) return false;
    return true;
  }
  std::string unit(std::size_t column) const {
    const int L = dim_ == 2 ? -1 : 0;  // plane flow: per unit of width
    switch (column) {
      case 0:
        return units_.of({1, L, -1});
      case 1:
        return units_.of({0, 3 + L, -1});
      case 6:
      case 7:
      case 8:
        return units_.of({1, 2 + L, -3});
      default:
        return units_.of({1, 1 + L, -2});
    }
  }

  PostUnits units_;
  std::size_t up_, normal_ = 0;
  int dim_ = 2;
  Where where_;
  TimeWindow window_;
  std::vector<Real> at_;
  std::array<std::optional<std::pair<Real, Real>>, 3> extent_;
  Real g_ = 9.81, level_ = 0;
  std::vector<std::vector<Real>> columns_;  // shape: (planes x columns_per_plane, states)
  std::vector<RunningMoments> moments_;
  std::size_t window_states_ = 0;
};

}  // namespace

std::unique_ptr<Analysis> read_flux_analysis(const MapReader& map, const PostSettings& settings) {
  return std::make_unique<FluxAnalysis>(map, settings);
}

}  // namespace courant
