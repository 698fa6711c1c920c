// What a restart file holds is a list: no number leaves it unnoticed.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "small_scene.hpp"

namespace courant {
namespace {

/// Names of all that runs of the decks keep, without the numbers in them: "passes/contact N of nodes/asleep".
std::set<std::string> kept_names() {
  const std::regex numbers("[0-9]+");
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(SOURCE_DIR "/tests/decks/accept")) {
    const std::string name = file.path().filename().string();
    if (!name.starts_with("whole") || file.path().extension() != ".k") continue;
    Diagnostics diagnostics;
    auto simulation = Simulation::build(file.path().string(), {}, diagnostics);
    SavedState state;
    Archive archive = Archive::saver(state);
    simulation->keep(archive);
    for (const auto& [path, array] : state) names.insert(std::regex_replace(path, numbers, "N"));
  }
  return names;
}

}  // namespace

TEST(Restart, EveryNameThatIsKeptIsListed) {
  const std::string list = SOURCE_DIR "/tests/unit/app/kept_names.txt";
  std::ifstream in(list);
  std::set<std::string> listed;
  for (std::string line; std::getline(in, line);) listed.insert(line);
  const std::set<std::string> kept = kept_names();
  if (std::getenv("COURANT_WRITE_KEPT_NAMES")) {
    std::ofstream out(list);
    for (const std::string& name : kept) out << name << '\n';
  }
  for (const std::string& name : listed) EXPECT_TRUE(kept.contains(name)) << "no longer kept: " << name;
  for (const std::string& name : kept)
    EXPECT_TRUE(listed.contains(name)) << "new, add it to kept_names.txt: " << name;
}

}  // namespace courant
