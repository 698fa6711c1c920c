#pragma once
// What can be found wrong with a suite before anything is run.
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "post/yaml_map.hpp"
#include "verify/suite.hpp"

namespace courant {

/// An expression of a case, checked once the names of its parameters are known.
struct CheckedExpression {
  /// What it is evaluated over, besides parameters.
  enum class Over { nothing, time, histories, particles, outcome };
  Location where;
  std::string name;  ///< "observation.of"
  std::string text;
  Over over = Over::nothing;
};

/// What a reference formula may name: particles for profiles, t for curves and for values at a moment.
CheckedExpression::Over over_of_formula(const SuiteObservation& observation);

/// Names that limits of stability cases may use besides parameters and observations.
const std::vector<std::string>& outcome_names();

/// Whether the keys of an observation fit each other; faults are reported at the map.
void check_observation(const MapReader& map, const SuiteObservation& observation);
/// Whether the table of a reference can be read.
void check_table(const MapReader& map, const SuiteReference& reference, Diagnostics& diagnostics);
/// Whether the keys of a case fit each other, and whether its expressions can be understood.
void check_case(const MapReader& map, const SuiteCase& definition,
                const std::vector<CheckedExpression>& expressions, Diagnostics& diagnostics);

}  // namespace courant
