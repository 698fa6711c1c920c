#include "output/ascii/text_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace courant {

namespace {

std::vector<TextHistory>& registry() {
  static std::vector<TextHistory> files;
  return files;
}

}  // namespace

const std::vector<TextHistory>& text_histories() {
  return registry();
}

// Files register in an order that the linker chooses.
RegisterTextHistory::RegisterTextHistory(TextHistory file) {
  const auto at =
      std::lower_bound(registry().begin(), registry().end(), file.name,
                       [](const TextHistory& a, const std::string& name) { return a.name < name; });
  registry().insert(at, std::move(file));
}

std::string history_text(const std::string& name, const Sample& sample, Real first_potential) {
  for (const TextHistory& file : text_histories())
    if (file.name == name) return file.text(sample, first_potential);
  throw std::out_of_range("no history " + name);
}

std::string history_head(const TextHistory& file, const HistoryTitles& titles) {
  if (!file.legend) return file.columns;
  const std::vector<Legend> legend = file.legend(titles);
  return (legend.empty() && !file.empty_legend ? "" : ascii_legend(legend)) + file.columns;
}

std::string ascii_legend(const std::vector<Legend>& entries) {
  std::string out = "\n{BEGIN LEGEND}\n Entity #        Title\n";
  for (const Legend& e : entries) out += fmt::format("{:9d}     {:<70.70}\n", e.id, e.title);
  return out + "{END LEGEND}\n";
}

}  // namespace courant
