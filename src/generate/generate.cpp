#include "generate/generate.hpp"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "generate/deck_writer.hpp"
#include "generate/scene.hpp"

namespace courant {
namespace {

/// Under a temporary name first: a full disk or a broken run leaves no half of a deck.
bool write_whole(const std::string& path, const std::string& text, Diagnostics& diagnostics) {
  const std::string part = path + ".part";
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    diagnostics.error({path, 0, 0}, "the deck cannot be written: this is a folder", "name a file: -o DECK.k");
    return false;
  }
  {
    std::ofstream file(part, std::ios::binary);
    if (!file) {
      diagnostics.error({path, 0, 0}, "the deck cannot be written",
                        "check that the folder exists and may be written to");
      return false;
    }
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) {
      std::filesystem::remove(part, ignored);
      diagnostics.error({path, 0, 0}, "the deck could not be written completely", "is the disk full?");
      return false;
    }
  }
  std::error_code fault;
  std::filesystem::rename(part, path, fault);
  if (!fault) return true;
  std::filesystem::remove(part, ignored);
  diagnostics.error({path, 0, 0}, "the deck cannot be written: " + fault.message());
  return false;
}

}  // namespace

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
  return write_whole(deck_path, text, diagnostics);
}

}  // namespace courant
