// kind: roller. The inside and the surface of a hydraulic jump against the empirical equations of Jonsson et
// al. (2016), eqs 2 to 5 (post/jump.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "post/analysis.hpp"
#include "post/jump.hpp"

namespace courant {
namespace {

constexpr Real none = std::numeric_limits<Real>::quiet_NaN();

/// What a vertical line of mean velocities tells.
struct Line {
  Real x = 0, largest = none, least = none;
  Real top_y = none, top = none;  // velocity at the highest point
};

/// Where `value` of the lines goes from below 0 to 0 or more for the first time behind x1, linear in between.
Real zero_behind(const std::vector<Line>& lines, Real x1, Real Line::*value) {
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Real a = lines[i - 1].*value, b = lines[i].*value;
    if (lines[i].x <= x1 || !(a < 0) || !(b >= 0)) continue;
    return lines[i - 1].x + a / (a - b) * (lines[i].x - lines[i - 1].x);
  }
  return none;
}

class RollerAnalysis : public Analysis {
 public:
  RollerAnalysis(const MapReader& map, const PostSettings& settings)
      : Analysis("roller", map), units_(settings.units) {
    map.allow(
        {"kind", "name", "profile", "velocity", "surface", "spectrum", "toe", "v1", "d1", "g", "decay_to"});
    map.text("profile", profile_);
    map.text("velocity", velocity_);
    map.text("surface", surface_);
    map.text("spectrum", spectrum_);
    map.text("toe", toe_, true);
    map.positive("v1", v1_, true);
    map.positive("d1", d1_, true);
    map.positive("g", g_);
    map.positive("decay_to", decay_to_);
    if (profile_.empty() && surface_.empty() && spectrum_.empty())
      map.error(map.node(), fmt::format("'{}' names no analysis to look at", map.name()),
                "add some of: profile, surface, spectrum");
  }

  bool needs_states() const override { return false; }
  std::vector<std::pair<const char*, std::string>> refers() const override {
    std::vector<std::pair<const char*, std::string>> out;
    if (!profile_.empty()) out.emplace_back("profile", profile_);
    if (!surface_.empty()) out.emplace_back("surface", surface_);
    if (!spectrum_.empty()) out.emplace_back("spectrum", spectrum_);
    if (Real number = 0; !YAML::convert<double>::decode(YAML::Node(toe_), number))
      out.emplace_back("toe", toe_);
    return out;
  }

  void finish(const std::vector<std::unique_ptr<Analysis>>& earlier, const std::filesystem::path&,
              Diagnostics& diagnostics) override {
    if (!find_toe(earlier, diagnostics)) return;
    Fr1_ = froude(v1_, d1_, g_);
    add_scalar("Fr1", "-", Fr1_);
    add_scalar("toe", units_.of({0, 1, 0}), x1_);
    result_.text = fmt::format("  Fr1 = {:.3f}, toe at x1 = {:.4g} {}\n  {:<44}{:>10}{:>12}{:>9}\n", Fr1_,
                               x1_, units_.length, "", "here", "reference", "");
    if (!profile_.empty()) look_inside(earlier, diagnostics);
    if (!surface_.empty()) look_at_surface(earlier, diagnostics);
    if (!spectrum_.empty()) look_at_spectrum(earlier, diagnostics);
    PostTable& numbers = add_table("numbers");  // one row, for figures over the Froude number
    for (const PostScalar& scalar : result_.scalars)
      numbers.columns.push_back({scalar.name, scalar.unit, {scalar.value}});
  }

 private:
  /// `toe` is a number, or the name of an analysis of kind toe, whose mean counts.
  bool find_toe(const std::vector<std::unique_ptr<Analysis>>& earlier, Diagnostics& diagnostics) {
    if (YAML::convert<double>::decode(YAML::Node(toe_), x1_)) return true;
    const Analysis* source = find_analysis(earlier, toe_, *this, diagnostics);
    if (!source) return false;
    for (const PostScalar& scalar : source->result().scalars)
      if (scalar.name == "toe_mean") x1_ = scalar.value;
    if (source->kind() == "toe" && std::isfinite(x1_)) return true;
    fault(diagnostics, fmt::format("'{}' found no toe in its window in time", toe_));
    return false;
  }

  /// Columns of a table of an analysis above; empty if it is not there or lacks one, which is reported.
  std::vector<const PostColumn*> columns(const std::vector<std::unique_ptr<Analysis>>& earlier,
                                         const std::string& name, const std::string& table_name,
                                         std::vector<std::string> wanted, Diagnostics& diagnostics) const {
    const Analysis* source = find_analysis(earlier, name, *this, diagnostics);
    if (!source) return {};
    for (const PostTable& table : source->result().tables) {
      if (table.name != table_name) continue;
      std::vector<const PostColumn*> out;
      for (const std::string& column : wanted) {
        out.push_back(table.find(column));
        if (out.back()) continue;
        fault(diagnostics, fmt::format("the table '{}' has no column '{}'", table_name, column));
        return {};
      }
      return out;
    }
    fault(diagnostics, fmt::format("the analysis '{}' has no table '{}'", name, table_name));
    return {};
  }

  void compare(const std::string& name, const std::string& title, Real here, Real reference,
               const char* equation) {
    add_scalar(name, "-", here);
    add_scalar(name + "_reference", "-", reference);
    const std::string number = std::isnan(here) ? "none" : fmt::format("{:.4g}", here);
    const std::string error = std::isnan(here) ? "" : fmt::format("{:+.0f} %", 100 * (here / reference - 1));
    result_.text +=
        fmt::format("  {:<44}{:>10}{:>12.4g}{:>9}  {}\n", title, number, reference, error, equation);
  }

  void look_inside(const std::vector<std::unique_ptr<Analysis>>& earlier, Diagnostics& diagnostics) {
    const auto found = columns(earlier, profile_, profile_, {"x", "y", velocity_}, diagnostics);
    if (found.empty()) return;
    std::map<Real, Line> by_x;
    for (std::size_t i = 0; i < found[0]->values.size(); ++i) {
      const Real x = found[0]->values[i], y = found[1]->values[i], u = found[2]->values[i];
      Line& line = by_x[x];
      line.x = x;
      if (std::isnan(u)) continue;
      line.largest = std::fmax(line.largest, u), line.least = std::fmin(line.least, u);
      if (!(y <= line.top_y)) line.top_y = y, line.top = u;
    }
    std::vector<Line> lines;
    for (const auto& [x, line] : by_x) lines.push_back(line);
    PostTable& table = add_table();
    const char* names[] = {"x", "distance", "largest", "least", "top", "decay"};
    for (const char* name : names) table.columns.push_back({name, name[0] == 'x' ? units_.length : "-", {}});
    RunningMoments error;
    for (const Line& line : lines) {
      const Real distance = (line.x - x1_) / d1_;
      const Real row[] = {line.x,           distance,       line.largest / v1_,
                          line.least / v1_, line.top / v1_, velocity_decay(distance)};
      for (std::size_t c = 0; c < 6; ++c) table.columns[c].values.push_back(row[c]);
      if (distance > 0 && distance <= decay_to_) error.add(std::pow(row[2] / row[5] - 1, 2));
    }
    const Real theory = roller_length_over_d1(Fr1_);
    compare("roller_length", "roller: mean velocity nowhere negative, Lr/d1",
            (zero_behind(lines, x1_, &Line::least) - x1_) / d1_, theory, "eq. 2");
    compare("roller_length_surface", "roller: stagnation point at the surface, Lr/d1",
            (zero_behind(lines, x1_, &Line::top) - x1_) / d1_, theory, "eq. 2");
    add_scalar("decay_rms", "-", std::sqrt(error.mean_or_nan()));
    result_.text += fmt::format("  {:<44}{:>9.1f} %{:>12}{:>9}  eq. 3\n",
                                fmt::format("Vmax against its decay, rms up to {:g} d1", decay_to_),
                                100 * std::sqrt(error.mean_or_nan()), "0 %", "");
  }

  void look_at_surface(const std::vector<std::unique_ptr<Analysis>>& earlier, Diagnostics& diagnostics) {
    const auto found =
        columns(earlier, surface_, surface_ + "_mean", {"x", "mean", "deviation"}, diagnostics);
    if (found.empty()) return;
    PostTable& table = add_table("surface");
    for (const char* name : {"distance", "mean", "deviation"}) table.columns.push_back({name, "-", {}});
    Real largest = none, place = none;
    for (std::size_t i = 0; i < found[0]->values.size(); ++i) {
      const Real row[] = {(found[0]->values[i] - x1_) / d1_, found[1]->values[i] / d1_,
                          found[2]->values[i] / d1_};
      for (std::size_t c = 0; c < 3; ++c) table.columns[c].values.push_back(row[c]);
      if (row[0] >= 0 && !(row[2] <= largest)) largest = row[2], place = row[0];
    }
    compare("deviation_largest", "largest deviation of the surface, eta'/d1", largest,
            largest_deviation_over_d1(Fr1_), "eq. 4");
    add_scalar("deviation_largest_at", "-", place);
    result_.text += fmt::format("  {:<44}{:>10.3g}\n", "  found at (x - x1)/d1", place);
  }

  void look_at_spectrum(const std::vector<std::unique_ptr<Analysis>>& earlier, Diagnostics& diagnostics) {
    const auto found = columns(earlier, spectrum_, spectrum_ + "_peaks", {"x", "f"}, diagnostics);
    if (found.empty()) return;
    PostTable& table = add_table("frequency");
    table.columns = {{"distance", "-", {}}, {"f", units_.of({0, 0, -1}), {}}, {"strouhal", "-", {}}};
    std::vector<Real> over_roller;  // eq. 2's, so that it does not hang on what was found of a roller
    for (std::size_t i = 0; i < found[0]->values.size(); ++i) {
      const Real f = found[1]->values[i];
      const Real row[] = {(found[0]->values[i] - x1_) / d1_, f, f * d1_ / v1_};
      for (std::size_t c = 0; c < 3; ++c) table.columns[c].values.push_back(row[c]);
      if (row[0] > 0 && row[0] <= roller_length_over_d1(Fr1_)) over_roller.push_back(row[2]);
    }
    Real dominant = none;
    const Analysis* source = find_analysis(earlier, spectrum_, *this, diagnostics);
    for (const PostScalar& scalar : source->result().scalars)
      if (scalar.name == "dominant_of_mean") dominant = scalar.value;
    add_scalar("frequency", units_.of({0, 0, -1}), dominant);
    compare("strouhal", "Strouhal number of the mean spectrum, f d1/v1", dominant * d1_ / v1_,
            surface_strouhal(Fr1_), "eq. 5");
    result_.text += fmt::format("  {:<44}{:>10.3g}{:>12.3g}{:>9}  {}\n", "  as a frequency", dominant,
                                surface_strouhal(Fr1_) * v1_ / d1_, "", units_.of({0, 0, -1}));
    // A gauge past which the toe drifts slowly swings more than all others: in the mean spectrum it decides,
    // in the median it counts once.
    compare("strouhal_median", "Strouhal number, median over the roller", median(std::move(over_roller)),
            surface_strouhal(Fr1_), "eq. 5");
  }

  PostUnits units_;
  std::string profile_, velocity_ = "vx_mean", surface_, spectrum_, toe_;
  Real v1_ = 1, d1_ = 1, g_ = 9.81,
       decay_to_ = 20;  // decay_to: up to that distance the decay is compared [d1]
  Real x1_ = none, Fr1_ = 0;
};

}  // namespace

std::unique_ptr<Analysis> read_roller_analysis(const MapReader& map, const PostSettings& settings) {
  return std::make_unique<RollerAnalysis>(map, settings);
}

}  // namespace courant
