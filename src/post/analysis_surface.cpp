// kind: surface. Depth of the water over time on lines against gravity.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parallel/parallel.hpp"
#include "post/analysis.hpp"

namespace courant {
namespace {

class SurfaceAnalysis : public Analysis {
 public:
  SurfaceAnalysis(const MapReader& map, const PostSettings& settings)
      : Analysis("surface", map), units_(settings.units), up_(settings.up) {
    // across: the second coordinate that lies in the bed
    map.allow(
        {"kind", "name", "where", "link", "share", "x", "across", "bed", "surface", "layers", "from", "to"});
    where_ = read_where(map);
    spray_ = read_spray(map);
    read_window(map, window_);
    x_ = read_places(map, "x", true);
    map.number("across", across_);
    first_ = read_choice(map, "surface", {"top", "first"}) == 1;
    if (const auto node = map.get("layers", false))
      if (!node->IsScalar() || !YAML::convert<bool>::decode(*node, layers_))
        map.error(*node, fmt::format("'{}.layers' must be true or false", map.name()));
    CompiledExpression bed("0", {"x"});
    if (const auto node = map.get("bed", false)) bed = read_expression(map, *node, "bed", {"x"});
    for (Real x : x_) bed_.push_back(bed.ok() ? bed(&x) : 0);
    columns_.resize(x_.size());
    moments_.resize(x_.size());
    wet_.assign(x_.size(), 0);
    filled_.assign(x_.size(), 0);
  }

  void note_needs(std::vector<ParticleArray>& arrays) const override { note_arrays(where_.of, arrays); }

  void take(const PostState& state) override {
    const ParticleGrid& water = state.water(where_.text, where_.of, spray_);
    const bool in_window = window_.holds(state.frame.t, state.slack);
    std::vector<std::vector<WaterInterval>> found(x_.size());
    std::vector<Real> filled(x_.size());
    for_each(static_cast<Index>(x_.size()), [&](Index i) {
      const auto k = static_cast<std::size_t>(i);
      found[k] =
          water_on_line(water, {x_[k], up_ == 1 ? 0 : across_, up_ == 1 ? across_ : 0}, up_, &filled[k]);
    });
    times_.push_back(state.frame.t);
    window_states_ += in_window;
    for (std::size_t k = 0; k < x_.size(); ++k) {
      const Real depth = depth_of(found[k], bed_[k], water.largest_h());
      columns_[k].push_back(depth);
      if (in_window) moments_[k].add(depth), wet_[k] += depth > 0, filled_[k] += filled[k];
      if (!layers_) continue;
      for (const WaterInterval& piece : found[k]) {
        const Real row[] = {state.frame.t, x_[k], piece.low, piece.high};
        for (std::size_t c = 0; c < 4; ++c) layer_columns_[c].push_back(row[c]);
      }
    }
  }

  std::vector<PostSeries> series() const override {
    std::vector<PostSeries> out;
    for (std::size_t k = 0; k < x_.size(); ++k)
      out.push_back({x_.size() == 1 ? "depth" : "depth@" + short_number(x_[k]), units_.of({0, 1, 0}), x_[k],
                     columns_[k]});
    return out;
  }

  void finish(const std::vector<std::unique_ptr<Analysis>>&, const std::filesystem::path&,
              Diagnostics& diagnostics) override {
    if (window_states_ == 0) return fault_no_state(diagnostics);
    const std::string length = units_.of({0, 1, 0}), time = units_.of({0, 0, 1});
    PostTable& over_time = add_table();
    over_time.columns.push_back({"t", time, times_});
    for (PostSeries& one : series()) over_time.columns.push_back({one.name, one.unit, std::move(one.values)});
    std::vector<Real> mean, deviation, least, most, wet, filled;
    for (std::size_t k = 0; k < x_.size(); ++k) {
      mean.push_back(moments_[k].mean);
      deviation.push_back(moments_[k].deviation());
      least.push_back(moments_[k].least), most.push_back(moments_[k].most);
      wet.push_back(wet_[k] / static_cast<Real>(window_states_));
      filled.push_back(filled_[k] / static_cast<Real>(window_states_));
    }
    if (x_.size() == 1) {
      add_scalar("depth_mean", length, mean.front());
      add_scalar("depth_deviation", length, deviation.front());
      add_scalar("filled_mean", length, filled.front());
    }
    add_table("mean").columns = {{"x", length, x_},        {"bed", length, bed_},
                                 {"mean", length, mean},   {"deviation", length, deviation},
                                 {"least", length, least}, {"most", length, most},
                                 {"wet", "-", wet},        {"filled", length, filled}};
    if (layers_)
      add_table("layers").columns = {{"t", time, layer_columns_[0]},
                                     {"x", length, layer_columns_[1]},
                                     {"low", length, layer_columns_[2]},
                                     {"high", length, layer_columns_[3]}};
    result_.text +=
        fmt::format("  {} places, {} states; mean of {} states\n", x_.size(), times_.size(), window_states_);
  }

 private:
  /// The top of the highest piece of water over the bed, or of the lowest one that touches the bed; 0 if
  /// there is none.
  Real depth_of(const std::vector<WaterInterval>& pieces, Real bed, Real h) const {
    Real depth = 0;
    for (const WaterInterval& piece : pieces) {
      if (piece.high <= bed) continue;
      if (first_) return piece.low <= bed + 2 * h ? piece.high - bed : 0;
      depth = piece.high - bed;
    }
    return depth;
  }

  PostUnits units_;
  std::size_t up_;
  Where where_;
  SprayRule spray_;
  TimeWindow window_;
  std::vector<Real> x_, bed_;
  Real across_ = 0;
  bool first_ = false, layers_ = false;
  std::vector<std::vector<Real>> columns_;  // shape: (places, states)
  std::vector<RunningMoments> moments_;
  std::vector<Real> wet_, filled_;
  std::size_t window_states_ = 0;
  std::array<std::vector<Real>, 4> layer_columns_;
};

}  // namespace

std::unique_ptr<Analysis> read_surface_analysis(const MapReader& map, const PostSettings& settings) {
  return std::make_unique<SurfaceAnalysis>(map, settings);
}

}  // namespace courant
