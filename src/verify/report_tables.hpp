#pragma once
// The tables of the reports, free of any markup.
#include <cstddef>
#include <string>
#include <vector>

#include "verify/results.hpp"

namespace courant::report {

inline constexpr std::size_t most_open_rows = 30;  ///< of a table; a longer one is opened by the reader

struct Table {
  struct Column {
    std::string head;
    bool numeric = false;
  };
  struct Row {
    std::vector<std::string> cells;
    bool bad = false;  ///< stands out
  };
  std::vector<Column> columns;
  std::vector<Row> rows;
};

/// All runs of a case: size, cost and what was observed in each. Columns that would be empty are left out.
Table runs_table(const CaseResult& result);

/// What is bounded, what was measured, and whether that is within the bound.
Table checks_table(const CaseResult& result);

/// One row for each case: title, runs, CPU time, bounds met of all. The first column is the title.
Table overview_table(const SuiteResult& result);

/// "cubic, wave speed: error at most 1 %, measured 3.2 %"
std::string check_text(const BoundCheck& check);

std::size_t missed(const CaseResult& result);  ///< bounds that are not met

}  // namespace courant::report
