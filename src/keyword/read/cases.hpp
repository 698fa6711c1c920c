#pragma once
// *CASE, *CASE_BEGIN_n, *CASE_END_n: one deck, several runs. They are searched in the text before the deck is
// read: each run then reads the deck with the lines of the others as comments, so that line numbers do not
// change.
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/real.hpp"

namespace courant {

struct LoadCase {
  Id id = 0;
  std::string job;        ///< JOBID, or CASE and the id: names the folder of its results
  std::set<Id> subcases;  ///< n of the blocks that it has
};

/// The cases of a text in their order: those of *CASE, or, where there is none, one for each n of
/// *CASE_BEGIN_n. Faults go to `diagnostics`: blocks that do not end, cases without blocks, COMMANDS.
std::vector<LoadCase> cases_in(const std::string& file, std::string_view text, Diagnostics& diagnostics);

/// The text with what does not belong to a case as comments: keywords of cases, and what is in blocks
/// none of which is the case's.
std::string text_of_case(std::string_view text, const std::set<Id>& subcases);

/// The whole of a file; nothing if it cannot be read.
std::optional<std::string> text_of_file(const std::string& path);

/// Whether a line of a text begins with *CASE.
bool has_cases(std::string_view text);

}  // namespace courant
