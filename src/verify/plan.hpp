#pragma once
// The runs of a suite.
#include <filesystem>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "generate/expression.hpp"
#include "verify/suite.hpp"

namespace courant {

struct PlannedRun {
  std::size_t of_case = 0;         ///< index in Suite::cases
  std::string setting;             ///< name of the setting and swept values of a stability case
  std::string resolution{};        ///< blank: none
  SuiteParameters parameters{};    ///< overrides handed to scene or deck
  Variables variables{};           ///< values of all parameters that expressions may name
  Real size = 0;                   ///< SuiteCase::size; 0: none
  bool finest = true;              ///< of its setting
  std::filesystem::path folder{};  ///< relative to the folder of results
};

/// Values of the parameters of a case with `overrides`: of a scene all it has; of a deck, those of the
/// overrides that are numbers. Faults of the scene go to `diagnostics`.
Variables parameter_values(const SuiteCase& definition, const SuiteParameters& overrides,
                           Diagnostics& diagnostics);

/// The overrides of a run: those of the case, of the setting and the resolution, later ones first.
SuiteParameters overrides_of(const SuiteCase& definition, const SuiteSetting& setting,
                             const std::string& resolution);

/// All runs in the order of the suite: cases, settings, then resolutions from coarse to fine or swept values,
/// the first parameter outermost. What is wrong with a run's parameters goes to `diagnostics`, at the case.
std::vector<PlannedRun> plan_runs(const Suite& suite, Diagnostics& diagnostics);

}  // namespace courant
