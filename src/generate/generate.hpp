#pragma once
// `courant generate`: a keyword deck from a YAML scene of particle lattices and shell plates.
#include <map>
#include <string>

#include "base/diagnostic.hpp"

namespace courant {

/// Reads the scene at `scene_path`, with `params` (NAME -> number or expression) in place of its defaults,
/// and writes a fixed-format deck to `deck_path`. False, with messages in `diagnostics` and no file written
/// or changed, if the scene is wrong or the file cannot be written. The deck depends on scene and parameters
/// alone: no dates, no paths.
bool generate_deck(const std::string& scene_path, const std::string& deck_path,
                   const std::map<std::string, std::string>& params, Diagnostics& diagnostics);

}  // namespace courant
