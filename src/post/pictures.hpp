#pragma once
#include <filesystem>

#include "base/diagnostic.hpp"

namespace courant {

/// Draws the pictures that `dir/plot.json` describes with the Python script plot.py (matplotlib), which
/// stands beside this source or, installed, in share/courant. What is missing (script, python3, matplotlib)
/// or fails gives a warning, as numbers and tables do not depend on it. Returns whether the pictures were
/// drawn.
bool draw_pictures(const std::filesystem::path& dir, Diagnostics& diagnostics);

}  // namespace courant
