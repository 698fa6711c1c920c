#include "verify/pareto.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verify/report_text.hpp"

namespace courant::report {
namespace {

constexpr std::size_t most_choices = 6;  // in words

/// The smallest of 1, 2, 5 times a power of ten that is not below `error`.
Real round_level(Real error) {
  if (error <= 0) return 0;
  const Real decade = std::pow(Real(10), std::floor(std::log10(error)));
  for (const Real digit : {1, 2, 5})
    if (error <= digit * decade * (1 + 1e-9)) return digit * decade;
  return 10 * decade;
}

bool ended_well(const RunResult& run) {
  return run.exit_code == 0 && run.verdict <= Verdict::degraded;
}

}  // namespace

std::vector<CostPoint> pareto_front(std::vector<CostPoint> points) {
  std::erase_if(points, [](const CostPoint& p) {
    return !std::isfinite(p.cost) || !std::isfinite(p.error) || p.cost < 0 || p.error < 0;
  });
  std::stable_sort(points.begin(), points.end(), [](const CostPoint& a, const CostPoint& b) {
    return a.cost < b.cost || (a.cost == b.cost && a.error < b.error);
  });
  std::vector<CostPoint> front;
  for (const CostPoint& p : points)
    if (front.empty() || p.error < front.back().error) front.push_back(p);
  return front;
}

std::vector<Choice> choices(const std::vector<CostPoint>& front) {
  std::vector<Choice> all;
  for (const CostPoint& p : front) {
    const Real level = round_level(p.error);
    if (all.empty() || level < all.back().level) all.push_back({level, p});
  }
  return all;
}

std::vector<CostPoint> cost_points(const CaseResult& result, std::size_t observation) {
  const std::vector<SuiteObservation>& observations = result.definition.observations;
  const bool by_finest = observation < observations.size() &&
                         observations[observation].reference.kind == SuiteReference::Kind::finest;
  std::vector<CostPoint> points;
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    const RunResult& run = result.runs[i];
    if (!ended_well(run) || observation >= run.observed.size()) continue;
    const std::optional<Real>& error = run.observed[observation].error;
    if (error && !(by_finest && *error == 0)) points.push_back({i, run.cpu_seconds, *error});
  }
  return points;
}

std::optional<std::size_t> cheapest_within_bounds(const CaseResult& result) {
  const std::vector<SuiteObservation>& observations = result.definition.observations;
  if (std::none_of(observations.begin(), observations.end(),
                   [](const auto& o) { return o.bound.has_value(); }))
    return {};
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    const RunResult& run = result.runs[i];
    bool within = ended_well(run) && std::isfinite(run.cpu_seconds);
    for (std::size_t k = 0; k < observations.size() && within; ++k) {
      if (!observations[k].bound) continue;
      within = k < run.observed.size() && run.observed[k].error &&
               *run.observed[k].error <= *observations[k].bound;
    }
    if (within && (!best || run.cpu_seconds < result.runs[*best].cpu_seconds)) best = i;
  }
  return best;
}

std::string run_name(const RunResult& run) {
  if (run.resolution.empty()) return run.setting.empty() ? "the run" : run.setting;
  return run.setting.empty() ? "resolution " + run.resolution
                             : run.setting + " at resolution " + run.resolution;
}

std::vector<std::string> recommendation(const CaseResult& result, std::size_t observation) {
  const std::vector<Choice> all = choices(pareto_front(cost_points(result, observation)));
  std::vector<std::string> text;
  // Evenly along the front, the first and the last one among them: more than a few are no advice.
  const std::size_t shown = std::min(all.size(), most_choices);
  for (std::size_t i = 0; i < shown; ++i) {
    const Choice& choice = all[shown > 1 ? i * (all.size() - 1) / (shown - 1) : 0];
    const RunResult& run = result.runs[choice.point.run];
    const std::string what = choice.level > 0 ? "at most " + percent(choice.level) : "zero";
    text.push_back(fmt::format("{}: {}, {} (error {}).", what, run_name(run), seconds(choice.point.cost),
                               percent(choice.point.error)));
  }
  if (observation >= result.definition.observations.size()) return text;
  const std::optional<Real>& bound = result.definition.observations[observation].bound;
  if (all.empty() || !bound) return text;
  if (all.back().point.error > *bound)
    text.push_back(fmt::format("No run reaches the bound of {}; the smallest error is {}.", percent(*bound),
                               percent(all.back().point.error)));
  return text;
}

}  // namespace courant::report
