#include "read_and_build.hpp"

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>

#include "keyword/deck.hpp"
#include "model/build_model.hpp"

namespace courant::fuzz {

namespace {

constexpr std::string_view separator = "$$FILE ";

std::map<std::string, std::string> split_files(std::string_view input) {
  std::map<std::string, std::string> files;
  std::string name = "deck.k";
  for (bool more = true; more;) {
    const std::size_t at = input.rfind(separator, 0) == 0 ? 0 : input.find("\n$$FILE ");
    const std::size_t begin = at == 0 ? 0 : at == std::string_view::npos ? input.size() : at + 1;
    files.emplace(name, input.substr(0, begin));
    input.remove_prefix(begin);
    more = !input.empty();
    if (!more) break;
    input.remove_prefix(separator.size());
    const std::size_t end = std::min(input.find('\n'), input.size());
    name = input.substr(0, end);
    input.remove_prefix(std::min(end + 1, input.size()));
  }
  return files;
}

/// What the decks of tests/decks include, by the names that they use.
const std::map<std::string, std::string>& bases() {
  static const std::map<std::string, std::string> files = [] {
    std::map<std::string, std::string> out;
    for (const auto& file : std::filesystem::directory_iterator(BASE_DECKS)) {
      std::stringstream text;
      text << std::ifstream(file.path()).rdbuf();
      out.emplace("../base/" + file.path().filename().string(), text.str());
    }
    return out;
  }();
  return files;
}

}  // namespace

void read_and_build(std::string_view input) {
  const std::map<std::string, std::string> files = split_files(input);
  ReadOptions options;
  options.open = [&](const std::string& path) -> std::optional<std::string> {
    if (const auto it = files.find(path); it != files.end()) return it->second;
    if (const auto it = bases().find(path); it != bases().end()) return it->second;
    return std::nullopt;
  };
  Diagnostics diagnostics;
  const Deck deck = read_deck("deck.k", options, diagnostics);
  if (diagnostics.ok()) build_model(deck, diagnostics);
  diagnostics.text();
}

}  // namespace courant::fuzz
