#include "verify/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/formula.hpp"
#include "verify/series.hpp"
#include "verify/suite_check.hpp"

namespace courant {
namespace {

constexpr Real none = std::numeric_limits<Real>::quiet_NaN();

/// The runs of a setting, from coarse to fine.
std::vector<const RunResult*> runs_of(const std::vector<RunResult>& runs, const std::string& setting) {
  std::vector<const RunResult*> out;
  for (const RunResult& run : runs)
    if (run.setting == setting) out.push_back(&run);
  return out;
}

bool counts(const SuiteObservation& o, const std::string& setting) {
  return o.bound_settings.empty() ||
         std::find(o.bound_settings.begin(), o.bound_settings.end(), setting) != o.bound_settings.end();
}

void check_observation(const SuiteObservation& o, std::size_t k, const std::string& setting,
                       const std::vector<const RunResult*>& runs, std::vector<BoundCheck>& out) {
  const bool by_finest = o.reference.kind == SuiteReference::Kind::finest;
  const std::size_t last =
      runs.size() - (by_finest ? 2 : 1);  // check_counts has seen to it that there are two
  for (const RunResult* run : runs) {
    const Observed& observed = run->observed[k];
    if (run->exit_code == 0 && observed.found && !observed.error && !observed.why.empty())
      out.push_back({setting, o.name, "an error to compare: " + observed.why, 0, none, false});
  }
  if (!o.bound || !counts(o, setting)) return;
  const Real error = runs[last]->observed[k].error.value_or(none);
  out.push_back({setting, o.name, "error at most", *o.bound, error, error <= *o.bound});
}

}  // namespace

std::vector<MeasuredOrder> measured_orders(const SuiteCase& definition, const std::vector<RunResult>& runs) {
  std::vector<MeasuredOrder> out;
  if (definition.size.empty() || definition.stability) return out;
  for (const SuiteSetting& setting : definition.settings) {
    for (std::size_t k = 0; k < definition.observations.size(); ++k) {
      if (definition.observations[k].reference.kind == SuiteReference::Kind::none) continue;
      std::vector<Real> size, error;
      for (const RunResult* run : runs_of(runs, setting.name)) {
        const std::optional<Real> e = run->observed[k].error;
        if (!e || !(*e > 0)) continue;
        size.push_back(std::log(run->size));
        error.push_back(std::log(*e));
      }
      out.push_back({setting.name, definition.observations[k].name, slope_of(size, error)});
    }
  }
  return out;
}

std::vector<BoundCheck> check_bounds(const SuiteCase& definition, const std::vector<RunResult>& runs,
                                     const std::vector<MeasuredOrder>& orders) {
  std::vector<BoundCheck> out;
  for (const RunResult& run : runs)
    if (run.verdict != Verdict::stable)
      out.push_back({run.setting, "",
                     run.resolution.empty()
                         ? "runs to its end"
                         : fmt::format("{} = {} runs to its end", definition.resolution, run.resolution),
                     1, 0, false});
  for (const SuiteSetting& setting : definition.settings) {
    const auto of_setting = runs_of(runs, setting.name);
    for (std::size_t k = 0; k < definition.observations.size(); ++k) {
      const SuiteObservation& o = definition.observations[k];
      check_observation(o, k, setting.name, of_setting, out);
      if (!o.least_order || !counts(o, setting.name)) continue;
      Real order = none;
      for (const MeasuredOrder& m : orders)
        if (m.setting == setting.name && m.observation == o.name) order = m.order.value_or(none);
      out.push_back({setting.name, o.name, "order at least", *o.least_order, order, order >= *o.least_order});
    }
  }
  return out;
}

BoundCheck judge_stability(const SuiteStability& stability, const PlannedRun& planned,
                           const RunNumbers& numbers, RunResult& run) {
  std::vector<std::string> names = outcome_names();
  std::vector<Real> values = {numbers.residual, numbers.ratio, numbers.leaked, numbers.penetration,
                              numbers.steps};
  if (const auto dx = planned.variables.find("dx"); dx != planned.variables.end() && dx->second > 0)
    values[3] /= dx->second;
  for (const Observed& observed : run.observed) {
    names.push_back(observed.name);
    values.push_back(observed.found ? observed.value.value_or(none) : none);
  }
  for (const SuiteStability::Limit& limit : stability.limits) {
    if (run.verdict != Verdict::stable && run.verdict != Verdict::degraded) break;
    Formula value(limit.value, names, planned.variables), at_most(limit.at_most, names, planned.variables);
    const Real is = value.ok() ? value(values.data()) : none,
               bound = at_most.ok() ? at_most(values.data()) : none;
    if (is <= bound) continue;
    std::string why;
    for (const Observed& observed : run.observed)
      if (!observed.found && limit.value.find(observed.name) != std::string::npos)
        why = fmt::format(" ({}: {})", observed.name, observed.why);
    run.exceeded.push_back(fmt::format("{} = {:.4g} > {:.4g}{}", limit.name, is, bound, why));
    run.verdict = Verdict::degraded;
  }
  std::string why;
  const bool must_stop = constant_value(stability.must_stop, planned.variables, why) > 0,
             must_be_stable =
                 constant_value(stability.must_be_stable, planned.variables, why) > 0 && !must_stop;
  const bool ended = run.verdict == Verdict::stopped || run.verdict == Verdict::refused;
  run.as_required = run.verdict != Verdict::broken;
  if (must_be_stable) run.as_required = run.verdict == Verdict::stable;
  if (must_stop) run.as_required = ended;
  if (!why.empty()) run.as_required = false;
  const std::string what = !why.empty()     ? "what is required: " + why
                           : must_stop      ? "stopped or refused"
                           : must_be_stable ? "stable"
                                            : "anything but broken";
  return {run.setting, "", what, 1, run.as_required ? 1.0 : 0.0, run.as_required};
}

}  // namespace courant
