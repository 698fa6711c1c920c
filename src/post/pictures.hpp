#pragma once
#include <filesystem>

#include "base/diagnostic.hpp"

namespace courant {

/// Draws the pictures that a JSON file in `dir` describes with a Python script (matplotlib): plot.py draws
/// those of plot.json, plot_figures.py those of figures.json. Scripts stand beside this source or, installed,
/// in share/courant. What is missing (script, python3, matplotlib) or fails gives a warning, as numbers and
/// tables do not depend on it. Returns whether the pictures were drawn.
bool draw_pictures(const std::filesystem::path& dir, const char* script, Diagnostics& diagnostics);

}  // namespace courant
