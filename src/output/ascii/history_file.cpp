#include "output/ascii/history_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace courant {

namespace {

std::vector<HistoryFile>& registry() {
  static std::vector<HistoryFile> files;
  return files;
}

}  // namespace

const std::vector<HistoryFile>& history_files() {
  return registry();
}

// Files register in an order that the linker chooses.
RegisterHistoryFile::RegisterHistoryFile(HistoryFile file) {
  const auto at =
      std::lower_bound(registry().begin(), registry().end(), file.name,
                       [](const HistoryFile& a, const std::string& name) { return a.name < name; });
  registry().insert(at, std::move(file));
}

std::string history_text(const std::string& name, const Sample& sample, Real first_potential) {
  for (const HistoryFile& file : history_files())
    if (file.name == name) return file.text(sample, first_potential);
  throw std::out_of_range("no history " + name);
}

std::string ascii_legend(const std::vector<Legend>& entries) {
  std::string out = "\n{BEGIN LEGEND}\n Entity #        Title\n";
  for (const Legend& e : entries) out += fmt::format("{:9d}     {:<70.70}\n", e.id, e.title);
  return out + "{END LEGEND}\n";
}

}  // namespace courant
