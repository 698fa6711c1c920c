#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "keyword/deck.hpp"

namespace courant {

using Files = std::map<std::string, std::string>;

/// Options by which these files exist, and no others.
inline ReadOptions in_memory(Files files) {
  ReadOptions out;
  out.open = [files = std::move(files)](const std::string& path) -> std::optional<std::string> {
    const auto it = files.find(path);
    return it == files.end() ? std::nullopt : std::optional<std::string>(it->second);
  };
  return out;
}
/// The same for one file, deck.k.
inline ReadOptions in_memory(const std::string& text) {
  return in_memory(Files{{"deck.k", text}});
}

struct ReadDeck {
  Deck deck;
  Diagnostics diagnostics;
};

inline ReadDeck read_in_memory(const ReadOptions& options, const std::string& path = "deck.k") {
  ReadDeck out;
  out.deck = read_deck(path, options, out.diagnostics);
  return out;
}

/// The same files, which also tell what was asked for; [0] of `asked` is the first name that was looked for.
struct DecksInMemory {
  Files files;
  std::vector<std::string> asked{};

  ReadOptions options() {
    ReadOptions out = in_memory(files);
    out.open = [this, open = out.open](const std::string& path) {
      asked.push_back(path);
      return open(path);
    };
    return out;
  }
  Deck read(const std::string& path, Diagnostics& diagnostics) {
    return read_deck(path, options(), diagnostics);
  }
};

}  // namespace courant
