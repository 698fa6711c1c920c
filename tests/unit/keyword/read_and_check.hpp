#pragma once
#include <filesystem>
#include <string>

#include "base/diagnostic.hpp"
#include "keyword/deck.hpp"
#include "model/build_model.hpp"

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

/// All checks of a deck, in the order in which a run does them; the text of all messages.
inline std::string read_and_check(const std::string& path) {
  Diagnostics diagnostics;
  const Deck deck = read_deck(path, {}, diagnostics);
  if (diagnostics.ok()) build_model(deck, diagnostics);
  return diagnostics.text();
}

}  // namespace courant
