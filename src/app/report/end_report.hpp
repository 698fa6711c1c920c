#pragma once
#include <string>
#include <vector>

#include "output/summary.hpp"

namespace courant {

/// The report at the end of a run: timing table, sums, ranges, warnings, banner. One line each.
std::vector<std::string> end_report(const Summary& summary);

/// What speaks against the results, but for an error that stopped the run, and what made it slow: one line
/// each, with advice.
std::vector<std::string> end_warnings(const Summary& summary);

/// Active particles, energy ratio of the last check of the guard, and leaks of a run under way.
std::string state_in_words(const World& world);

/// "51 s", "3 min 07 s", "2 h 05 min"
std::string duration(double seconds);

}  // namespace courant
