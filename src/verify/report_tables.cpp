#include "verify/report_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "verify/report_charts.hpp"
#include "verify/report_text.hpp"
#include "verify/svg_map.hpp"

namespace courant::report {
namespace {

/// Adds a column whose cells follow from the runs, unless all cells are blank.
void add_column(Table& table, const CaseResult& result, const std::string& head, bool numeric,
                const std::function<std::string(const RunResult&)>& cell) {
  std::vector<std::string> cells;
  for (const RunResult& run : result.runs) cells.push_back(cell(run));
  if (std::all_of(cells.begin(), cells.end(), [](const std::string& c) { return c.empty(); })) return;
  table.columns.push_back({head, numeric});
  for (std::size_t i = 0; i < cells.size(); ++i) table.rows[i].cells.push_back(std::move(cells[i]));
}

void add_cost(Table& table, const CaseResult& result) {
  const auto count = [](std::int64_t n) { return n > 0 ? integer(n) : std::string(); };
  add_column(table, result, "particles", true, [&](const RunResult& r) { return count(r.particles); });
  add_column(table, result, "steps", true, [&](const RunResult& r) { return count(r.steps); });
  add_column(table, result, "CPU time [s]", true,
             [](const RunResult& r) { return number(r.cpu_seconds, 3); });
  add_column(table, result, "wall time [s]", true,
             [](const RunResult& r) { return number(r.wall_seconds, 3); });
  add_column(table, result, "CPU ns per particle-step", true, [](const RunResult& r) {
    return r.particle_steps > 0 ? number(1e9 * r.cpu_seconds / static_cast<double>(r.particle_steps), 3) : "";
  });
  add_column(table, result, "memory [MB]", true, [](const RunResult& r) {
    return r.peak_memory_bytes > 0 ? megabytes(r.peak_memory_bytes) : "";
  });
}

/// The order belongs to all runs of a setting and stands beside the last of them.
std::string order_beside(const CaseResult& result, const RunResult& run, const std::string& observation) {
  const auto last = std::find_if(result.runs.rbegin(), result.runs.rend(),
                                 [&](const RunResult& r) { return r.setting == run.setting; });
  if (last == result.runs.rend() || &*last != &run) return {};
  for (const MeasuredOrder& o : result.orders)
    if (o.setting == run.setting && o.observation == observation && o.order)
      return fmt::format("{:.2f}", *o.order);
  return {};
}

void add_observation(Table& table, const CaseResult& result, std::size_t k) {
  const SuiteObservation& observation = result.definition.observations[k];
  const std::string name = title_of(observation);
  const std::string unit = observation.unit.empty() ? "" : " [" + observation.unit + "]";
  const auto part = [&](const RunResult& run, std::optional<Real> Observed::*member) -> std::optional<Real> {
    return k < run.observed.size() ? run.observed[k].*member : std::nullopt;
  };
  add_column(table, result, name + unit, true, [&](const RunResult& run) {
    const std::optional<Real> value = part(run, &Observed::value);
    return value ? number(*value, 5) : "";
  });
  add_column(table, result, name + ": reference" + unit, true, [&](const RunResult& run) {
    const std::optional<Real> value = part(run, &Observed::reference);
    return value ? number(*value, 5) : "";
  });
  add_column(table, result, name + ": error", true, [&](const RunResult& run) -> std::string {
    const std::optional<Real> error = part(run, &Observed::error);
    if (error) return percent(*error);
    return k < run.observed.size() && !run.observed[k].found ? "not found" : "";
  });
  add_column(table, result, name + ": order", true,
             [&](const RunResult& run) { return order_beside(result, run, observation.name); });
}

std::string end_of(const RunResult& run) {
  if (run.exit_code == 0) return run.reused ? "as planned (earlier call)" : "as planned";
  std::string text = fmt::format("exit code {}", run.exit_code);
  if (!run.termination.empty()) text += ", " + run.termination;
  return run.reason.empty() ? text : text + ": " + run.reason;
}

std::string amount(const BoundCheck& check, Real value) {
  if (check.what.starts_with("error")) return percent(value);
  return check.what.find("at most") != std::string::npos || check.what.find("at least") != std::string::npos
             ? number(value, 3)
             : std::string();
}

}  // namespace

Table runs_table(const CaseResult& result) {
  Table table;
  table.rows.resize(result.runs.size());
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    const RunResult& run = result.runs[i];
    table.rows[i].bad = !run.as_required || (!result.definition.stability && run.exit_code != 0);
  }
  add_column(table, result, "setting", false, [](const RunResult& r) { return r.setting; });
  const std::string& resolution = result.definition.resolution;
  add_column(table, result, resolution.empty() ? "resolution" : resolution, true,
             [](const RunResult& r) { return r.resolution; });
  if (result.definition.stability)
    add_column(table, result, "verdict", false, [](const RunResult& r) {
      return std::string(word_for(r.verdict)) + (r.as_required ? "" : ", not allowed here");
    });
  add_cost(table, result);
  for (std::size_t k = 0; k < result.definition.observations.size(); ++k) add_observation(table, result, k);
  add_column(table, result, "limits exceeded", false,
             [](const RunResult& r) { return fmt::format("{}", fmt::join(r.exceeded, "; ")); });
  const bool all_well = std::all_of(result.runs.begin(), result.runs.end(),
                                    [](const RunResult& r) { return r.exit_code == 0 && !r.reused; });
  if (!all_well) add_column(table, result, "end", false, end_of);
  return table;
}

Table checks_table(const CaseResult& result) {
  Table table{{{"setting"}, {"of"}, {"required"}, {"bound", true}, {"measured", true}, {"met"}}, {}};
  for (const BoundCheck& check : result.checks)
    table.rows.push_back(
        {{check.setting.empty() ? "all" : check.setting, check.observation, check.what,
          amount(check, check.bound), amount(check, check.measured), check.met ? "yes" : "MISSED"},
         !check.met});
  return table;
}

Table overview_table(const SuiteResult& result) {
  Table table{{{"case"}, {"verdict"}, {"bounds met", true}, {"runs", true}, {"CPU time", true}}, {}};
  for (const CaseResult& c : result.cases) {
    double cpu = 0;
    for (const RunResult& run : c.runs) cpu += run.cpu_seconds;
    const std::size_t bad = missed(c);
    const std::string bounds =
        c.checks.empty() ? "none stated" : fmt::format("{} of {}", c.checks.size() - bad, c.checks.size());
    std::string word = bad > 0 ? "MISSED" : c.checks.empty() ? "" : "met";
    if (c.definition.stability) word += (word.empty() ? "" : "; ") + verdict_counts(c);
    table.rows.push_back({{c.definition.title.empty() ? c.definition.name : c.definition.title, word, bounds,
                           fmt::format("{}", c.runs.size()), seconds(cpu)},
                          bad > 0});
  }
  return table;
}

std::string check_text(const BoundCheck& check) {
  std::string text = check.setting;
  if (!check.observation.empty()) text += (text.empty() ? "" : ", ") + check.observation;
  text += (text.empty() ? "" : ": ") + check.what;
  const std::string bound = amount(check, check.bound);
  return bound.empty() ? text + (check.met ? ": yes" : ": no")
                       : text + " " + bound + ", measured " + amount(check, check.measured);
}

std::size_t missed(const CaseResult& result) {
  return static_cast<std::size_t>(
      std::count_if(result.checks.begin(), result.checks.end(), [](const BoundCheck& c) { return !c.met; }));
}

}  // namespace courant::report
