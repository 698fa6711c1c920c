#include "verify/report_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "verify/pareto.hpp"
#include "verify/report_text.hpp"
#include "verify/svg_chart.hpp"
#include "verify/svg_map.hpp"

namespace courant::report {
namespace {

constexpr std::size_t most_single_points = 40;  // of a reference that is drawn as points

/// Runs one after the other that have the same setting.
std::vector<std::string> setting_names(const CaseResult& result) {
  std::vector<std::string> names;
  for (const RunResult& run : result.runs)
    if (std::find(names.begin(), names.end(), run.setting) == names.end()) names.push_back(run.setting);
  return names;
}

std::string with_order(const CaseResult& result, const std::string& setting,
                       const SuiteObservation& observation) {
  const std::string name = setting.empty() ? "measured" : setting;
  for (const MeasuredOrder& o : result.orders)
    if (o.setting == setting && o.observation == observation.name && o.order)
      return fmt::format("{} (order {:.2f})", name, *o.order);
  return name;
}

std::string hover_of(const RunResult& run, const Observed& observed) {
  std::string text = run_name(run) + ": error " + percent(*observed.error) + ", " + seconds(run.cpu_seconds) +
                     " of CPU time";
  if (run.particles > 0) text += ", " + integer(run.particles) + " particles";
  return text;
}

std::string why_no_error(const RunResult& run, std::size_t k) {
  if (run.exit_code != 0) return run.reason.empty() ? "stopped" : run.reason;
  if (k >= run.observed.size()) return "not observed";
  return run.observed[k].why.empty() ? "no reference" : run.observed[k].why;
}

Chart error_chart_of(const CaseResult& result, std::size_t k) {
  const SuiteObservation& observation = result.definition.observations[k];
  Chart chart;
  chart.label = result.definition.title + ": error of " + title_of(observation) + " against CPU time";
  chart.x_label = "CPU time [s]", chart.y_label = "relative error (" + observation.norm + ")";
  if (observation.take != "curve" && observation.kind != SuiteObservation::Kind::profile)
    chart.y_label = "relative error";
  chart.log_x = chart.log_y = chart.percent_y = true;
  for (const std::string& setting : setting_names(result)) {
    ChartSeries series{with_order(result, setting, observation)};
    for (const RunResult& run : result.runs)
      if (run.setting == setting && k < run.observed.size() && run.observed[k].error)
        series.points.push_back({run.cpu_seconds, *run.observed[k].error, hover_of(run, run.observed[k])});
    if (!series.points.empty()) chart.series.push_back(std::move(series));
  }
  for (const CostPoint& p : pareto_front(cost_points(result, k))) chart.front.push_back({p.cost, p.error});
  if (observation.bound) chart.levels.push_back({"bound " + percent(*observation.bound), *observation.bound});
  return chart;
}

/// Error against CPU time; nothing for an observation without reference.
std::optional<Figure> error_figure(const CaseResult& result, std::size_t k) {
  const SuiteObservation& observation = result.definition.observations[k];
  const Chart chart = error_chart_of(result, k);
  if (chart.series.empty() && observation.reference.kind == SuiteReference::Kind::none) return {};
  Figure figure{
      observation.name + "-error", "Error of " + title_of(observation) + " against run time", {}, {}, {}};
  for (const RunResult& run : result.runs) {
    const bool has_error = k < run.observed.size() && run.observed[k].error;
    const bool strange = has_error && !(*run.observed[k].error > 0 && std::isfinite(*run.observed[k].error));
    if (!has_error)
      figure.notes.push_back(run_name(run) + " has no error: " + why_no_error(run, k) + ".");
    else if (strange)
      figure.notes.push_back(run_name(run) + ": error " + number(*run.observed[k].error) +
                             ", drawn at the edge.");
  }
  if (chart.series.empty())
    figure.notes.insert(figure.notes.begin(), "There is nothing to draw.");
  else
    figure.svg = svg_chart(chart);
  figure.advice = recommendation(result, k);
  return figure;
}

std::vector<ChartPoint> points_of(const std::vector<Real>& x, const std::vector<Real>& y) {
  std::vector<ChartPoint> points;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
    points.push_back({x[i], y[i], number(x[i]) + ", " + number(y[i])});
  return points;
}

void note_gaps(Figure& figure, const std::string& name, const std::vector<ChartPoint>& points) {
  const auto gaps = std::count_if(points.begin(), points.end(), [](const ChartPoint& p) {
    return !std::isfinite(p.x) || !std::isfinite(p.y);
  });
  if (gaps > 0)
    figure.notes.push_back(fmt::format("{}: {} of {} values are not finite numbers and are left out.", name,
                                       gaps, points.size()));
}

/// The curves of the first setting that has some, one for each resolution, with the reference of the finest.
std::optional<Figure> curve_figure(const CaseResult& result, std::size_t k) {
  const SuiteObservation& observation = result.definition.observations[k];
  const auto has_curve = [&](const RunResult& run) {
    return k < run.observed.size() && !run.observed[k].curve.x.empty();
  };
  const auto first = std::find_if(result.runs.begin(), result.runs.end(), has_curve);
  if (first == result.runs.end()) return {};
  Figure figure{observation.name + "-curve", title_of(observation), {}, {}, {}};
  if (!first->setting.empty()) figure.title += ", " + first->setting;
  Chart chart;
  chart.label = result.definition.title + ": " + title_of(observation);
  chart.x_label = observation.kind == SuiteObservation::Kind::profile ? observation.along : "t";
  chart.y_label = title_of(observation) + (observation.unit.empty() ? "" : " [" + observation.unit + "]");
  const ObservedCurve* finest = nullptr;
  for (const RunResult& run : result.runs) {
    if (run.setting != first->setting || !has_curve(run)) continue;
    const ObservedCurve& curve = run.observed[k].curve;
    const std::string name =
        run.resolution.empty() ? run_name(run) : result.definition.resolution + " " + run.resolution;
    chart.series.push_back({name, points_of(curve.x, curve.y), ChartSeries::Style::line});
    note_gaps(figure, name, chart.series.back().points);
    if (!curve.reference_x.empty()) finest = &curve;
  }
  if (finest != nullptr) {
    const bool few = finest->reference_x.size() <= most_single_points &&
                     observation.reference.kind == SuiteReference::Kind::csv;
    chart.series.push_back({"reference", points_of(finest->reference_x, finest->reference_y),
                            few ? ChartSeries::Style::reference_dots : ChartSeries::Style::reference_line});
    note_gaps(figure, "reference", chart.series.back().points);
  }
  figure.svg = svg_chart(chart);
  return figure;
}

/// One map, or one for each of several settings.
std::vector<Figure> map_figures(const CaseResult& result) {
  std::vector<Figure> all;
  const std::vector<SuiteSetting>& settings = result.definition.settings;
  for (std::size_t i = 0; i < std::max<std::size_t>(settings.size(), 1); ++i) {
    const std::string setting = settings.size() > 1 ? settings[i].name : "";
    const std::optional<StabilityMap> map = stability_map(result, setting);
    if (!map) return {};
    Figure figure{setting.empty() ? "map" : "map-" + setting, "Stability map", svg_map(*map), {}, {}};
    if (!setting.empty()) figure.title += ", " + setting;
    if (!map->value_name.empty()) figure.notes.push_back("Numbers in the cells: " + map->value_name + ".");
    all.push_back(std::move(figure));
  }
  all.back().notes.push_back(verdict_counts(result) + ".");
  for (const RunResult& run : result.runs)
    if (!run.as_required)
      all.back().notes.push_back(run_name(run) + " is " + word_for(run.verdict) +
                                 ", which the suite does not allow.");
  return all;
}

}  // namespace

std::string title_of(const SuiteObservation& observation) {
  return observation.title.empty() ? observation.name : observation.title;
}

std::string reference_text(const SuiteReference& reference) {
  std::string text = "none";
  switch (reference.kind) {
    case SuiteReference::Kind::none:
      break;
    case SuiteReference::Kind::formula:
      text = "formula " + reference.formula;
      break;
    case SuiteReference::Kind::csv:
      text = "table " + reference.csv.filename().string();
      break;
    case SuiteReference::Kind::finest:
      text = "the finest run";
      break;
  }
  return reference.source.empty() ? text : text + " (" + reference.source + ")";
}

std::vector<Figure> figures(const CaseResult& result) {
  std::vector<Figure> all;
  for (std::size_t k = 0; k < result.definition.observations.size(); ++k) {
    if (std::optional<Figure> figure = error_figure(result, k)) all.push_back(std::move(*figure));
    // Each run of a stability case is a setting of its own: a chart of the first one alone would say little.
    if (result.definition.stability) continue;
    if (std::optional<Figure> figure = curve_figure(result, k)) all.push_back(std::move(*figure));
  }
  for (Figure& figure : map_figures(result)) all.push_back(std::move(figure));
  if (all.empty() && !result.runs.empty())
    all.push_back({"none", "Charts", {}, {"Nothing is observed that could be drawn."}, {}});
  return all;
}

}  // namespace courant::report
