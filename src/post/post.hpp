#pragma once
// `courant post RECIPE.yaml DIR`
#include <filesystem>
#include <functional>
#include <string_view>

#include "base/diagnostic.hpp"

namespace courant {

/// Measures what the recipe asks for in the results of a run. Tables go to `say` as text of several lines;
/// into the run's folder go results.yaml, depth.csv (jump and probes over time), and for pictures
/// snapshots.csv, walls.csv, plot.json, depth.png and velocity.png; into its subfolder (recipe: folder) CSV,
/// tables.h5 and .vti files of the analyses, figures.json and the figures. `progress` gets a status line now
/// and then. Faults of recipe and folder go to `diagnostics`, also the warning where pictures could not be
/// drawn. Returns whether all but the pictures worked. Throws OutputError where a file cannot be written.
bool run_post(const std::filesystem::path& recipe, const std::filesystem::path& dir,
              const std::function<void(std::string_view)>& say, Diagnostics& diagnostics,
              const std::function<void(const std::string&)>& progress = {});

}  // namespace courant
