#pragma once
// Which runs are worth their time: pure functions of what was measured.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "verify/results.hpp"

namespace courant::report {

/// What a run costs and how wrong it is.
struct CostPoint {
  std::size_t run = 0;  ///< index in CaseResult::runs
  double cost = 0;      ///< CPU time [s]
  Real error = 0;       ///< [-]
};

/// The points that no other one beats: from the cheapest on, each with a smaller error than all cheaper ones.
/// Points whose cost or error is not finite or is negative take no part. Of equal points the first one stays.
std::vector<CostPoint> pareto_front(std::vector<CostPoint> points);

/// A round error level (1, 2 or 5 times a power of ten) and the cheapest run that reaches it.
struct Choice {
  Real level = 0;  ///< the smallest round level that the run reaches [-]; 0: no error at all
  CostPoint point;
};

/// Choices along a Pareto front, cheapest first; runs that reach no smaller level than a cheaper one are left
/// out.
std::vector<Choice> choices(const std::vector<CostPoint>& front);

/// Runs of a case that ended as they should and have an error of this observation, in the order of the runs.
/// Where the finest run is the reference, a run without any error is that run itself, and takes no part.
std::vector<CostPoint> cost_points(const CaseResult& result, std::size_t observation);

/// The cheapest run that meets the bounds of all observations that have one; none if no run does, or if
/// nothing is bounded.
std::optional<std::size_t> cheapest_within_bounds(const CaseResult& result);

/// The choices in words, for a list of the cheapest runs for an error of: "at most 1 %: cubic at resolution
/// 40, 3.1 s (error 0.8 %)." The time is CPU time. At most six, spread along the front. The last one tells
/// the smallest error if it misses the bound of the observation.
std::vector<std::string> recommendation(const CaseResult& result, std::size_t observation);

/// "cubic at resolution 40", or what of it is there.
std::string run_name(const RunResult& run);

}  // namespace courant::report
