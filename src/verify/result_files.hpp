#pragma once
// What a suite came to, as files for programs.
#include <filesystem>
#include <string>

#include "verify/results.hpp"

namespace courant {

/// Whether the checks that belong to a row of results.csv are met: "met", "missed", or blank if there are
/// none. Checks of a setting belong to its last run.
std::string check_of_row(const CaseResult& result, std::size_t run, const std::string& observation);

/// results.csv: one row per run and observation, and one for a run without observations.
std::string results_csv(const SuiteResult& result);
/// results.yaml: all of the result but curves and pictures.
std::string results_yaml(const SuiteResult& result);

/// Both, each whole or not at all. Throws OutputError.
void write_result_files(const SuiteResult& result, const std::filesystem::path& folder);

}  // namespace courant
