#pragma once
// One analysis of a recipe: it sees the states of a run one after the other, then gives tables.
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "post/particle_grid.hpp"
#include "post/quantity.hpp"
#include "post/table.hpp"
#include "post/units.hpp"
#include "post/water_body.hpp"

namespace courant {

/// What all analyses of a recipe share.
struct PostSettings {
  PostUnits units;
  std::size_t up = 1;  ///< axis against gravity: 1 is y, 2 is z
};

/// A window in time, both ends with the slack of a quarter of the spacing of states, because a state is
/// written up to one time step early.
struct TimeWindow {
  Real from = -std::numeric_limits<Real>::infinity(), to = std::numeric_limits<Real>::infinity();  ///< [T]
  bool holds(Real t, Real slack) const { return t >= from - slack && t <= to + slack; }
  bool holds_any(const std::vector<Real>& times) const;  ///< with the slack of these times
};

/// One state, with what analyses have in common made once.
class PostState {
 public:
  PostState(const ParticleFrame& frame, Real slack, const std::filesystem::path& folder)
      : frame(frame), slack(slack), folder(folder) {}
  /// The active particles for which `where` > 0, sorted into cells. `text` tells selections apart.
  const ParticleGrid& selection(const std::string& text, const CompiledExpression& where) const;
  /// Those of a selection that are no spray.
  const ParticleGrid& water(const std::string& text, const CompiledExpression& where,
                            const SprayRule& rule) const;

  const ParticleFrame& frame;
  const Real slack;                     ///< a quarter of the spacing of states [T]
  const std::filesystem::path& folder;  ///< for files of single states

 private:
  mutable std::map<std::string, ParticleGrid> selections_, waters_;
};

/// Series over time that a spectrum or another analysis may take up.
struct PostSeries {
  std::string name, unit;
  std::optional<Real> x;     ///< where, if it belongs to a place [L]
  std::vector<Real> values;  ///< one per entry of the times; NaN: none
};

struct PostResult {
  std::vector<PostTable> tables;    ///< the first is the main one
  std::vector<PostScalar> scalars;  ///< go to results.yaml
  std::vector<PostImage> images;
  std::string text;  ///< lines for the user
};

class Analysis {
 public:
  Analysis(std::string kind, const MapReader& map);
  virtual ~Analysis() = default;
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  const std::string& kind() const { return kind_; }
  const std::string& name() const { return name_; }
  const Location& where() const { return where_; }
  const std::string& file() const { return file_; }

  /// Arrays that it needs of each state.
  virtual void note_needs(std::vector<ParticleArray>&) const {}
  virtual bool needs_states() const { return true; }
  /// Analyses that must stand above it: the key of the recipe and the name there.
  virtual std::vector<std::pair<const char*, std::string>> refers() const { return {}; }
  /// Whether it looks at a state of time t at all.
  virtual bool looks_at(Real, Real /*slack*/) const { return true; }
  virtual void take(const PostState&) {}
  /// Makes the result. `earlier`: the analyses that stand above it in the recipe. Faults are reported at
  /// where().
  virtual void finish(const std::vector<std::unique_ptr<Analysis>>& earlier, const std::filesystem::path& dir,
                      Diagnostics& diagnostics) = 0;

  const PostResult& result() const { return result_; }
  /// Times of the series [T], and the series; complete when all states were taken.
  virtual const std::vector<Real>& times() const { return times_; }
  virtual std::vector<PostSeries> series() const { return {}; }

 protected:
  PostTable& add_table(const std::string& suffix = {});
  void add_scalar(const std::string& name, const std::string& unit, Real value);
  void fault(Diagnostics& diagnostics, const std::string& message, const std::string& hint = {}) const;
  void fault_no_state(Diagnostics& diagnostics) const;  ///< in its window in time

  PostResult result_;
  std::vector<Real> times_;

 private:
  std::string kind_, name_, file_;
  Location where_;
};

/// The analysis above with a name, or nullptr; a fault is reported.
const Analysis* find_analysis(const std::vector<std::unique_ptr<Analysis>>& earlier, const std::string& name,
                              const Analysis& asking, Diagnostics& diagnostics);

/// Mean and deviation of numbers that come one by one; NaN is left out. Source: Welford, Technometrics 4
/// (1962).
struct RunningMoments {
  Real n = 0, mean = 0, squares = 0;
  Real least = std::numeric_limits<Real>::infinity(), most = -std::numeric_limits<Real>::infinity();
  void add(Real value);
  Real deviation() const;  ///< of the population: divided by n; NaN for n = 0
  Real mean_or_nan() const;
};

/// NaN is left out; NaN if nothing is left.
Real median(std::vector<Real> values);

// Keys that several kinds share.
/// A quarter of the mean distance of states: what a window takes in beyond its ends. `times`: increasing.
Real slack_of(const std::vector<Real>& times);
void read_window(const MapReader& map, TimeWindow& window);  ///< from, to
/// Text of a number for names of columns: "0.025".
std::string short_number(Real value);
/// A number, a list of numbers, or {from, to, step}. Faults are reported.
std::vector<Real> read_places(const MapReader& map, const char* key, bool required);
/// `key: [a, b]` with a < b.
std::optional<std::pair<Real, Real>> read_range(const MapReader& map, const char* key, bool required = false);
/// One of several words; the first one if the key is not there. Faults are reported.
std::size_t read_choice(const MapReader& map, const char* key, const std::vector<std::string>& words);
/// Which particles count, `where: 2.5 - part`.
struct Where {
  std::string text = "1";
  CompiledExpression of{"1", quantity_variables()};
};
Where read_where(const MapReader& map);
SprayRule read_spray(const MapReader& map);                                           ///< link, share
std::vector<Quantity> read_quantities(const MapReader& map, const PostUnits& units);  ///< of: [vx, ...]

/// Makes the analysis of one entry of `analyses`. Faults are reported; then the pointer may be null.
std::unique_ptr<Analysis> read_analysis(const MapReader& map, const PostSettings& settings);

// One for each kind, beside its code.
std::unique_ptr<Analysis> read_probe_analysis(const MapReader& map, const PostSettings& settings);
std::unique_ptr<Analysis> read_surface_analysis(const MapReader& map, const PostSettings& settings);
std::unique_ptr<Analysis> read_grid_analysis(const MapReader& map, const PostSettings& settings);
std::unique_ptr<Analysis> read_profile_analysis(const MapReader& map, const PostSettings& settings);
std::unique_ptr<Analysis> read_spectrum_analysis(const MapReader& map, const PostSettings& settings);
std::unique_ptr<Analysis> read_flux_analysis(const MapReader& map, const PostSettings& settings);
std::unique_ptr<Analysis> read_history_analysis(const MapReader& map, const PostSettings& settings);
std::unique_ptr<Analysis> read_force_analysis(const MapReader& map, const PostSettings& settings);
std::unique_ptr<Analysis> read_toe_analysis(const MapReader& map, const PostSettings& settings);
std::unique_ptr<Analysis> read_roller_analysis(const MapReader& map, const PostSettings& settings);

}  // namespace courant
