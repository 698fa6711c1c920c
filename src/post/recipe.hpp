#pragma once
// What `courant post` is asked to measure: the content of a recipe (YAML).
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/real.hpp"
#include "post/analysis.hpp"
#include "post/figures.hpp"

namespace courant {

struct Interval {
  Real from = 0, to = 0;
};

/// Water depth over time on a vertical line.
struct ProbeRecipe {
  std::string name;
  Real x = 0, z = 0;  ///< [L]
  Real bed = 0;       ///< level of the bed [L]
};

/// A row of published values to print beside ours.
struct PublishedRow {
  std::string case_name;  ///< "d1/4": compared with the recipe's case or the title of the run
  Interval interval;      ///< [T]
  Real A = 0, P = 0;
};

/// Depth behind a hydraulic jump against Belanger's conjugate depth.
struct JumpRecipe {
  Real x = 0, z = 0, bed = 0;       ///< where depth is taken [L]
  Real v1 = 0, d1 = 0, g = 9.81;    ///< inflow [L/T], [L], [L/T2]
  std::vector<Interval> intervals;  ///< over which A and P are taken [T]
  std::vector<PublishedRow> published;
  Interval toe_range;           ///< x between which the toe is looked for; none if empty [L]
  Real toe_threshold = 1.5;     ///< depth at the toe, in d1
  std::optional<Real> front_x;  ///< where the arrival of the wave is timed [L]
  Real front_threshold = 1.3;   ///< depth that tells the wave, in d1
};

/// Pictures of the velocity field.
struct SnapshotRecipe {
  std::vector<Real> times;  ///< [T]
  Interval range{0, 0};     ///< of the colour map; from the data if empty [L/T]
  Interval x, y;            ///< window; all particles if empty [L]
};

struct Recipe {
  std::string file;
  std::string case_name;  ///< optional: overrides what the title of the run tells
  std::vector<ProbeRecipe> probes;
  std::optional<JumpRecipe> jump;
  std::optional<SnapshotRecipe> snapshots;
  PostSettings settings;
  std::vector<std::unique_ptr<Analysis>> analyses;  ///< in the order of the recipe
  std::vector<Figure> figures;                      ///< drawn from the tables of analyses
  std::vector<std::string> formats{"png"};          ///< of the figures: png, svg, pdf
  std::string folder = "post";                      ///< in the run's folder, for what analyses write
};

/// Reads a recipe. Every fault is reported with its place; then there is no value.
std::optional<Recipe> read_recipe(const std::filesystem::path& file, Diagnostics& diagnostics);

}  // namespace courant
