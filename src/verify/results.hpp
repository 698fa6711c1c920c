#pragma once
// What came out of a suite, for the table, the CSV file and the reports.
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/real.hpp"
#include "verify/suite.hpp"

namespace courant {

/// A curve as it was compared: shapes (n).
struct ObservedCurve {
  std::vector<Real> x, y;
  std::vector<Real> reference_x, reference_y;  ///< empty: no reference
};

struct Observed {
  std::string name;
  bool found = false;  ///< false: the run has nothing of the kind; `why` tells
  std::string why;
  std::optional<Real> value;      ///< of scalars, [unit of the observation]
  std::optional<Real> reference;  ///< of scalars
  std::optional<Real> error;      ///< divided by its scale [-]; none without reference
  ObservedCurve curve;            ///< of series and profiles, thinned to at most 400 points for the report
};

enum class Verdict { stable, degraded, stopped, refused, broken };  // broken: crash, hang or garbage
inline constexpr std::array all_verdicts = {Verdict::stable, Verdict::degraded, Verdict::stopped,
                                            Verdict::refused, Verdict::broken};
/// "stable"
inline const char* word_for(Verdict verdict) {
  constexpr std::array words = {"stable", "degraded", "stopped", "refused", "broken"};
  return words[static_cast<std::size_t>(verdict)];
}

struct RunResult {
  std::string setting;     ///< or the swept values of a stability case: "tssfac = 0.9"
  std::string resolution;  ///< value of the swept parameter, as text
  SuiteParameters parameters;
  Real size = 0;  ///< of SuiteCase::size
  std::filesystem::path folder;
  int exit_code = 0;
  std::string termination, reason;
  double wall_seconds = 0, cpu_seconds = 0;
  std::int64_t particles = 0, steps = 0, particle_steps = 0, peak_memory_bytes = 0;
  std::vector<Observed> observed;  ///< in the order of SuiteCase::observations
  // of stability cases
  Verdict verdict = Verdict::stable;
  std::vector<std::string> exceeded;  ///< names of the limits exceeded, with their values
  bool as_required = true;            ///< the verdict is one that the case allows
  bool reused = false;                ///< taken from an earlier, interrupted call
};

/// A bound of the suite and what was measured against it.
struct BoundCheck {
  std::string setting, observation, what;  ///< what: "error at most", "order at least", "stable"
  Real bound = 0, measured = 0;
  bool met = false;
};

/// Order of convergence: slope of log(error) over log(size) by least squares; none with fewer than two
/// errors.
struct MeasuredOrder {
  std::string setting, observation;
  std::optional<Real> order;
};

struct ReportPicture {
  std::string png;               ///< bytes of the file
  std::string title, low, high;  ///< captions: what is shown, and the ends of the colour scale
};

struct CaseResult {
  SuiteCase definition;
  std::vector<RunResult> runs;  ///< settings outermost, resolutions from coarse to fine
  std::vector<BoundCheck> checks;
  std::vector<MeasuredOrder> orders;
  std::optional<ReportPicture> picture;
};

struct SuiteResult {
  Suite suite;
  std::string version, machine;  ///< of Courant with its build; processor, cores, system
  std::string date;              ///< ISO 8601, UTC
  double wall_seconds = 0;
  int jobs = 1;
  std::vector<CaseResult> cases;
  bool ok() const {
    for (const CaseResult& c : cases)
      for (const BoundCheck& check : c.checks)
        if (!check.met) return false;
    return true;
  }
};

}  // namespace courant
