#pragma once
// Orders of convergence, bounds and verdicts of a case.
#include <vector>

#include "verify/plan.hpp"
#include "verify/record.hpp"
#include "verify/results.hpp"

namespace courant {

/// Slopes of log(error) over log(size), for every setting and observation with a reference.
std::vector<MeasuredOrder> measured_orders(const SuiteCase& definition, const std::vector<RunResult>& runs);

/// Bounds of an accuracy case: errors and orders, and that every run came to its end with a scale for its
/// errors. A bound without an error to compare is missed.
std::vector<BoundCheck> check_bounds(const SuiteCase& definition, const std::vector<RunResult>& runs,
                                     const std::vector<MeasuredOrder>& orders);

/// Completes the verdict of a run of a stability case by its limits, and says whether it is as required.
/// Returns the check of that.
BoundCheck judge_stability(const SuiteStability& stability, const PlannedRun& planned,
                           const RunNumbers& numbers, RunResult& run);

}  // namespace courant
