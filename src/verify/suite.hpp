#pragma once
// A suite as its YAML file describes it: cases, each a deck or scene that is run for several values of its
// parameters, and what is compared with a reference. docs/user_guide.md explains the file to users.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/real.hpp"

namespace courant {

/// NAME: VALUE, handed to the scene or deck as --param. Values are text: numbers or expressions.
using SuiteParameters = std::map<std::string, std::string>;

/// One line of a case's chart: values of parameters that stay the same while the resolution is swept.
struct SuiteSetting {
  std::string name;
  SuiteParameters parameters;
  /// Values of the resolution for this setting alone; empty: those of the case.
  std::vector<std::string> resolutions;
};

/// What a run is compared with.
struct SuiteReference {
  enum class Kind { none, formula, csv, finest } kind = Kind::none;
  std::string formula;  ///< of t, or of x, y, z, t; may use the scene's parameters
  std::filesystem::path csv;
  std::string csv_x, csv_y;                    ///< columns by name or number from 1
  std::string scale_x = "1", scale_y = "1";    ///< factors on the columns, expressions of parameters
  std::string offset_x = "0", offset_y = "0";  ///< added after scaling
  std::string source;                          ///< where it comes from, for the report
};

/// One number, or curve, that is observed in a run and compared.
struct SuiteObservation {
  std::string name, title, unit;
  enum class Kind {
    history,    ///< `of`: expression of datasets of history.h5 ("global/kinetic + global/potential"), over t
    particles,  ///< `reduce` of the expression `of` over particles with `where` > 0, in each field state,
                ///< over t
    profile     ///< `of` of each particle with `where` > 0 at time `at`, over `along` (an expression)
  } kind = Kind::history;
  std::string of, where, along;
  /// profile: > 0: `reduce` of the particles in each of so many equal parts of the range of `along`.
  int bins = 0;
  std::string reduce = "mean";  ///< mean (by volume), sum, min, max, count, median, p01, p99 (percentiles)
  /// How a series becomes what is compared: curve (all of it), final, mean, min, max, at, period, decay,
  /// slope, growth. profile: curve; with bins also mean, min, max.
  std::string take = "curve";
  std::optional<std::string> from, to, at;  ///< window or moment in t, expressions of parameters
  SuiteReference reference;
  /// Against a csv, > 0: shift the curve so that it first reaches the y of this row of the csv at its x,
  /// where the two count time from different origins.
  int align = 0;
  std::string norm = "l2";  ///< of curves: l1, l2, linf (of the difference)
  std::string scale;  ///< the error is divided by this expression; blank: the same norm of the reference
  /// On the error, at the finest resolution of the settings named (all if none); the last but one where the
  /// finest run is the reference.
  std::optional<Real> bound;
  std::vector<std::string> bound_settings;
  std::optional<Real> least_order;  ///< measured order of convergence, of the same settings
};

/// A stability case: verdicts instead of errors.
struct SuiteStability {
  /// Swept parameters, at most two: the map's columns and rows.
  std::vector<std::pair<std::string, std::vector<std::string>>> sweep;
  /// NAME: expression that must be > 0, else the run is degraded; `value` is what the map shows. May use
  /// parameters, names of observations, and `residual` (energy residual over throughput), `ratio`, `leaked`,
  /// `penetration` (largest, over spacing if the scene has a parameter dx), `steps`.
  struct Limit {
    std::string name, value, at_most;
  };
  std::vector<Limit> limits;
  /// Expression of the swept parameters: where it is > 0, the run must be stable, else the suite fails.
  /// Elsewhere it may be stable, degraded, or stopped with an error that tells why.
  std::string must_be_stable = "1";
  /// Expression: where it is > 0 the run must be refused or stop (exit 1 or 2).
  std::string must_stop = "0";
};

struct SuiteCase {
  std::string name, title, about;
  std::filesystem::path scene, deck;  ///< one of them
  SuiteParameters parameters;         ///< for all runs of the case
  std::string resolution;             ///< name of the swept parameter; blank: none
  std::vector<std::string> resolutions;
  std::string size;  ///< expression of parameters: spacing, the abscissa of the order of convergence
  std::vector<SuiteSetting> settings;
  std::vector<SuiteObservation> observations;
  std::optional<SuiteStability> stability;
  Real time_limit = 1800;  ///< of a run, wall time [s]; one that takes longer is ended and counts as broken
  /// Particles of the finest run, drawn in colours by this expression at this time; blank: no picture.
  std::string picture_of, picture_title, picture_at, picture_where;
  Location where;
};

struct Suite {
  std::filesystem::path file;
  std::string title, about;
  std::vector<SuiteCase> cases;
};

/// Reads and checks a suite. All faults go to `diagnostics` with their line; the result counts only if
/// `diagnostics.ok()`.
Suite read_suite(const std::filesystem::path& file, Diagnostics& diagnostics);

}  // namespace courant
