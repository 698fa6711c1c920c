#pragma once
#include <map>
#include <string>
#include <vector>

#include "keyword/deck.hpp"

namespace courant {

/// Files of a deck that exist in memory only; [0] of `asked` is the first name that was looked for.
struct DecksInMemory {
  std::map<std::string, std::string> files;
  std::vector<std::string> asked{};

  ReadOptions options() {
    ReadOptions out;
    out.open = [this](const std::string& path) -> std::optional<std::string> {
      asked.push_back(path);
      const auto it = files.find(path);
      return it == files.end() ? std::nullopt : std::optional<std::string>(it->second);
    };
    return out;
  }
  Deck read(const std::string& path, Diagnostics& diagnostics) {
    return read_deck(path, options(), diagnostics);
  }
};

}  // namespace courant
