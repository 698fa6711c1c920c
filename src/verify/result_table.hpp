#pragma once
// What a suite came to, as text for the terminal.
#include <string>

#include "verify/results.hpp"

namespace courant {

/// A table of the runs of a case; of a stability case also the map of verdicts.
std::string case_table(const CaseResult& result);
/// The checks that were missed, and how many were met.
std::string checks_text(const SuiteResult& result);

}  // namespace courant
