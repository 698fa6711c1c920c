#pragma once
// What got better or worse since an earlier results.csv.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "verify/results.hpp"

namespace courant {

struct Comparison {
  struct Line {
    std::string text;
    bool worse = false;
  };
  std::vector<Line> lines;
  int compared = 0;        ///< rows that stand in both
  bool regressed = false;  ///< a check or verdict that was met is now missed
};

/// Rows are the same where case, setting, resolution and observation are. Told are errors that changed by
/// more than 5 % and 1e-12, CPU time per particle-step that changed by more than 30 % where both runs took
/// 0.2 s or more, verdicts, checks, and rows that are new or gone. A file that cannot be read, or is no
/// results.csv, goes to `diagnostics`; then there is no value.
std::optional<Comparison> compare_with(const SuiteResult& result, const std::filesystem::path& earlier,
                                       Diagnostics& diagnostics);

}  // namespace courant
