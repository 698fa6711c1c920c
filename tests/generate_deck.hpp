#pragma once
// Decks from scenes, for tests: by the Python package, as `courant generate` makes them.
#include <array>
#include <cstdio>
#include <map>
#include <string>

#include "base/diagnostic.hpp"

namespace courant::test {

inline std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// Writes the deck of a scene; false, with all that was said as one error, where it is wrong.
inline bool generate_deck(const std::string& scene, const std::string& deck,
                          const std::map<std::string, std::string>& parameters, Diagnostics& diagnostics) {
  std::string call = "PYTHONPATH=" + quoted(std::string(SOURCE_DIR) + "/src/python") +
                     " python3 -B -m courant generate " + quoted(scene) + " -o " + quoted(deck);
  for (const auto& [name, value] : parameters) call += " --param " + quoted(name + "=" + value);
  std::FILE* pipe = ::popen((call + " 2>&1").c_str(), "r");
  if (!pipe) return false;
  std::string said;
  std::array<char, 4096> some{};
  while (const std::size_t n = std::fread(some.data(), 1, some.size(), pipe)) said.append(some.data(), n);
  const bool made = ::pclose(pipe) == 0;
  if (!made) diagnostics.error({scene, 0, 0}, said);
  return made;
}

}  // namespace courant::test
