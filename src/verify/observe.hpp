#pragma once
// What is observed in the results of a run.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "generate/expression.hpp"
#include "verify/results.hpp"
#include "verify/series.hpp"
#include "verify/suite.hpp"

namespace courant {

/// An observation before it is compared.
struct Measured {
  bool found = false;
  std::string why;            ///< there is nothing
  Series series;              ///< within the window of the observation; empty if not found
  std::optional<Real> value;  ///< of scalars
  std::vector<Real> formula;  ///< of profiles with a formula as reference: its values; shape: (series)
};

struct Measurements {
  std::vector<Measured> observations;  ///< in the order of SuiteCase::observations
  std::string garbage;                 ///< what is not finite in histories or field states; blank: nothing
};

/// Reads history.h5 and the field states in `folder`. `variables`: parameters of the run. With `all_states`,
/// every state is looked through for numbers that are not finite, else those that are observed.
Measurements observe_run(const SuiteCase& definition, const Variables& variables,
                         const std::filesystem::path& folder, bool all_states);

/// A window or moment of an observation in its values; infinite where it is open.
struct MeasuredTimes {
  Real from = 0, to = 0;
  std::optional<Real> at;
  std::string why;  ///< an expression has no value; blank: all is well
};
MeasuredTimes window_of(const SuiteObservation& observation, const Variables& variables);

/// Compares with the reference. `finest`: the same observation in the finest run of the setting, if the
/// reference asks for it and this is another run.
Observed compare_observation(const SuiteObservation& observation, const Measured& measured,
                             const Variables& variables, const Measured* finest);

}  // namespace courant
