#include "generate/generate.hpp"

#include <filesystem>
#include <system_error>

#include "generate/deck_writer.hpp"
#include "generate/scene.hpp"
#include "output/file.hpp"

namespace courant {
bool generate_deck(const std::string& scene_path, const std::string& deck_path,
                   const std::map<std::string, std::string>& params, Diagnostics& diagnostics) {
  const int before = diagnostics.errors();
  const Scene scene = read_scene(scene_path, params, diagnostics);
  if (diagnostics.errors() > before) return false;
  for (const std::string& file : scene.files)
    if (std::error_code ignored; std::filesystem::equivalent(file, deck_path, ignored)) {
      diagnostics.error({deck_path, 0, 0}, "the deck would take the place of the scene, or of a base of it",
                        "give the deck another name: -o DECK.k");
      return false;
    }
  const std::string text =
      deck_text(scene, std::filesystem::path(scene_path).filename().string(), diagnostics);
  if (diagnostics.errors() > before) return false;
  try {
    write_named_file(deck_path, text);
    return true;
  } catch (const OutputError& error) {
    diagnostics.error({deck_path, 0, 0}, "the deck cannot be written: " + error.reason(),
                      "name a file that can be written, in a folder that exists: -o DECK.k");
    return false;
  }
}

}  // namespace courant
