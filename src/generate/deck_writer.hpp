#pragma once
#include <string>

#include "generate/scene.hpp"

namespace courant {

/// The deck of a scene. `scene_name` is named in its first comment. Ids are consecutive within a part; ids
/// that clash or do not fit their columns are errors.
std::string deck_text(const Scene& scene, const std::string& scene_name, Diagnostics& diagnostics);

}  // namespace courant
