#pragma once
#include <filesystem>
#include <string>

#include "app/run/simulation.hpp"

namespace courant {

/// Makes a folder the working directory for one test, so that messages name files without folders.
class WorkingDirectory {
 public:
  explicit WorkingDirectory(const std::string& folder) : old_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
  }
  ~WorkingDirectory() { std::filesystem::current_path(old_); }
  WorkingDirectory(const WorkingDirectory&) = delete;
  WorkingDirectory& operator=(const WorkingDirectory&) = delete;

 private:
  std::filesystem::path old_;
};

/// What `courant check` would say of a deck.
struct Checked {
  bool built = false;
  Diagnostics diagnostics;
};

/// All checks of a deck, just as a run does them.
inline Checked read_and_check(const std::string& path) {
  Checked out;
  out.built = Simulation::build(path, {}, out.diagnostics) != nullptr;
  return out;
}

}  // namespace courant
