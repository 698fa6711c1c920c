#pragma once
// The map of where a stability case holds and where it breaks.
#include <optional>
#include <string>
#include <vector>

#include "verify/results.hpp"

namespace courant::report {

struct MapCell {
  std::optional<Verdict> verdict;  ///< none: there is no such run
  bool as_required = true;
  std::string value;  ///< a short text below the verdict's letter
  std::string hover;
};

struct StabilityMap {
  std::string label;  ///< for those who cannot see the map
  std::string column_name, row_name;
  std::vector<std::string> columns, rows;  ///< values of the swept parameters; no rows: one parameter
  std::vector<MapCell> cells;              ///< row by row
  std::string value_name{};                ///< what the values in the cells are; blank: there are none
};

/// The map of a stability case: columns and rows as the suite has them; the longer sweep stands in rows where
/// it would be too wide. With a setting, its runs alone (their names begin
/// with it). Of several runs with the same swept values, the worst one stands in the cell.
/// Nothing for other cases.
std::optional<StabilityMap> stability_map(const CaseResult& result, const std::string& setting = {});

/// The letter that stands for a verdict, so that the map can be read without colours.
char verdict_letter(Verdict verdict);

/// "12 stable, 3 degraded, 1 stopped", those that occur.
std::string verdict_counts(const CaseResult& result);

/// The map as one `svg` element in the style of chart_style(). Cells are as wide as their texts need: a map
/// with more of them than fit into chart_width is wider than that. One parameter: rows of values below each
/// other.
std::string svg_map(const StabilityMap& map);

}  // namespace courant::report
