#include "verify/svg_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "verify/pareto.hpp"
#include "verify/report_text.hpp"
#include "verify/svg_chart.hpp"

namespace courant::report {
namespace {

constexpr Real cell_height = 40, least_width = 46;
constexpr std::size_t most_letters = 14;  // of a value of a swept parameter, or in a cell
constexpr std::size_t in_a_row = 7;       // more columns than that had better be rows

std::string styled_text(Real x, Real y, std::string_view anchor, std::string_view css,
                        std::string_view text) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}" class="{}">{}</text>)", x, y, anchor,
                     css, escape_xml(text));
}

std::string value_of(const RunResult& run) {
  for (const Observed& o : run.observed)
    if (o.found && o.value) return number(*o.value, 3);
  return {};
}

std::string hover_of(const RunResult& run) {
  std::string text = run.setting + ": " + word_for(run.verdict);
  if (!run.as_required) text += ", which the suite does not allow";
  for (const std::string& limit : run.exceeded) text += "; " + limit;
  for (const Observed& o : run.observed)
    if (o.value) text += "; " + o.name + " " + number(*o.value);
  if (run.verdict != Verdict::stable && !run.reason.empty()) text += "; " + run.reason;
  return text;
}

bool has(const RunResult& run, const std::string& name, const std::string& value) {
  const auto found = run.parameters.find(name);
  return found != run.parameters.end() && found->second == value;
}

void show(MapCell& cell, const RunResult& run) {
  const bool worse = !cell.verdict || run.verdict > *cell.verdict || (cell.as_required && !run.as_required);
  if (!cell.hover.empty()) cell.hover += '\n';
  cell.hover += hover_of(run);
  if (!worse) return;
  cell.verdict = run.verdict;
  cell.value = value_of(run);
  cell.as_required = cell.as_required && run.as_required;
}

/// A case that sweeps nothing: its runs by their names.
StabilityMap map_of_runs(const std::vector<RunResult>& runs) {
  StabilityMap map;
  for (const RunResult& run : runs) {
    map.columns.push_back(run_name(run));
    show(map.cells.emplace_back(), run);
  }
  return map;
}

void turn(StabilityMap& map) {
  std::vector<MapCell> cells;
  for (std::size_t c = 0; c < map.columns.size(); ++c)
    for (std::size_t r = 0; r < map.rows.size(); ++r) cells.push_back(map.cells[r * map.columns.size() + c]);
  std::swap(map.columns, map.rows);
  std::swap(map.column_name, map.row_name);
  map.cells = std::move(cells);
}

std::string css_name(const MapCell& cell) {
  return cell.verdict ? word_for(*cell.verdict) : "none";
}

std::string draw_cell(const MapCell& cell, Real x, Real y, Real width) {
  const std::string name = css_name(cell);
  std::string out = "<g>";
  if (!cell.hover.empty()) out += "<title>" + escape_xml(cell.hover) + "</title>";
  out += fmt::format(R"(<rect class="cell cell-{}" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)",
                     name, x, y, width, cell_height);
  if (!cell.as_required)
    out += fmt::format(R"(<rect class="fault" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)",
                       x + 2.5, y + 2.5, width - 5, cell_height - 5);
  std::string letter = cell.verdict ? std::string(1, verdict_letter(*cell.verdict)) : "–";
  if (!cell.as_required) letter += " ✗";
  const bool alone = cell.value.empty();
  out += styled_text(x + width / 2, y + (alone ? 25 : 17), "middle", "symbol on-cell on-" + name, letter);
  if (!alone)
    out +=
        styled_text(x + width / 2, y + 33, "middle", "on-cell on-" + name, shorten(cell.value, most_letters));
  return out + "</g>";
}

/// Columns of the map from `first` on with their header; `y` moves below them.
std::string draw_block(const StabilityMap& map, std::size_t first, std::size_t count, Real left, Real width,
                       Real& y) {
  std::string out;

  for (std::size_t c = 0; c < count; ++c) {
    const std::string& value = map.columns[first + c];
    out += "<g><title>" + escape_xml(map.column_name + " = " + value) + "</title>" +
           styled_text(left + (static_cast<Real>(c) + 0.5) * width, y + 14, "middle", "",
                       shorten(value, most_letters)) +
           "</g>";
  }
  y += 20;
  for (std::size_t r = 0; r < std::max<std::size_t>(map.rows.size(), 1); ++r) {
    if (!map.rows.empty())
      out += styled_text(left - 8, y + cell_height / 2 + 4.5, "end", "", shorten(map.rows[r], most_letters));
    for (std::size_t c = 0; c < count; ++c)
      out += draw_cell(map.cells[r * map.columns.size() + first + c], left + static_cast<Real>(c) * width, y,
                       width);
    y += cell_height;
  }
  return out;
}

std::size_t longest_of(const std::vector<std::string>& texts) {
  std::size_t longest = 0;
  for (const std::string& text : texts) longest = std::max(longest, std::min(length(text), most_letters));
  return longest;
}

/// So that no text reaches into the next cell.
Real least_cell_width(const StabilityMap& map) {
  std::size_t longest = longest_of(map.columns);
  for (const MapCell& cell : map.cells) longest = std::max(longest, longest_of({cell.value}));
  return std::max(least_width, digit_width * static_cast<Real>(longest) + 8);
}

std::string draw_legend(const StabilityMap& map, Real full_width, Real& y) {
  std::string out;
  Real x = 8;
  const auto entry = [&](const MapCell& sample, const std::string& text) {
    const Real width = 30 + letter_width * static_cast<Real>(length(text)) + 14;
    if (x > 8 && x + width > full_width) x = 8, y += 24;
    out += fmt::format(R"(<rect class="cell cell-{}" x="{:.1f}" y="{:.1f}" width="22" height="20"/>)",
                       css_name(sample), x, y);
    if (!sample.as_required)
      out += fmt::format(R"(<rect class="fault" x="{:.1f}" y="{:.1f}" width="19" height="17"/>)", x + 1.5,
                         y + 1.5);
    const std::string letter = !sample.as_required ? "✗"
                               : sample.verdict    ? std::string(1, verdict_letter(*sample.verdict))
                                                   : "–";
    const bool own_paper = sample.verdict.has_value();
    out += styled_text(x + 11, y + 15, "middle",
                       own_paper ? "symbol on-cell on-" + css_name(sample) : "symbol on-none", letter);
    out += styled_text(x + 28, y + 15, "start", "", text);
    x += width;
  };
  for (const Verdict v : all_verdicts) {
    const auto n =
        std::count_if(map.cells.begin(), map.cells.end(), [&](const MapCell& c) { return c.verdict == v; });
    if (n > 0) entry({v, true, {}, {}}, fmt::format("{} ({})", word_for(v), n));
  }
  const auto faults =
      std::count_if(map.cells.begin(), map.cells.end(), [](const MapCell& c) { return !c.as_required; });
  if (faults > 0) entry({{}, false, {}, {}}, fmt::format("not allowed here ({})", faults));
  const auto missing =
      std::count_if(map.cells.begin(), map.cells.end(), [](const MapCell& c) { return !c.verdict; });
  if (missing > 0) entry({}, fmt::format("no run ({})", missing));
  y += 28;
  return out;
}

}  // namespace

char verdict_letter(Verdict verdict) {
  switch (verdict) {
    case Verdict::stable:
      return 'S';
    case Verdict::degraded:
      return 'D';
    case Verdict::stopped:
      return 'X';
    case Verdict::refused:
      return 'R';
    case Verdict::broken:
      break;
  }
  return '!';
}

std::string verdict_counts(const CaseResult& result) {
  std::string text;
  for (const Verdict v : all_verdicts) {
    const auto n = std::count_if(result.runs.begin(), result.runs.end(),
                                 [&](const RunResult& r) { return r.verdict == v; });
    if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, word_for(v));
  }
  return text;
}

std::optional<StabilityMap> stability_map(const CaseResult& result, const std::string& setting) {
  if (!result.definition.stability) return {};
  std::vector<RunResult> runs;
  for (const RunResult& run : result.runs)
    if (setting.empty() || run.setting == setting || run.setting.starts_with(setting + ", "))
      runs.push_back(run);
  const auto& sweep = result.definition.stability->sweep;
  StabilityMap map;
  if (sweep.empty()) {
    map = map_of_runs(runs);
  } else {
    const auto& [name, values] = sweep[0];
    map.column_name = name, map.columns = values;
    if (sweep.size() > 1) map.row_name = sweep[1].first, map.rows = sweep[1].second;
    map.cells.resize(map.columns.size() * std::max<std::size_t>(map.rows.size(), 1));
    for (std::size_t i = 0; i < map.cells.size(); ++i)
      for (const RunResult& run : runs)
        if (has(run, name, map.columns[i % map.columns.size()]) &&
            (map.rows.empty() || has(run, map.row_name, map.rows[i / map.columns.size()])))
          show(map.cells[i], run);
    if (map.columns.size() > in_a_row && !map.rows.empty() && map.rows.size() < map.columns.size()) turn(map);
  }
  map.label = result.definition.title + ": " + verdict_counts(result);
  for (const RunResult& run : runs)
    for (const Observed& o : run.observed)
      if (map.value_name.empty() && o.found && o.value) map.value_name = o.name;
  return map;
}

std::string svg_map(const StabilityMap& map) {
  const Real left = map.rows.empty() ? 8 : 16 + digit_width * static_cast<Real>(longest_of(map.rows));
  const Real least = least_cell_width(map);
  const std::size_t count = std::max<std::size_t>(
      map.rows.empty() ? std::min(map.columns.size(), static_cast<std::size_t>((chart_width - 16) / least))
                       : map.columns.size(),
      1);
  const Real width =
      std::clamp((chart_width - left - 8) / static_cast<Real>(count), least, std::max(least, Real(90)));
  const Real full = std::max<Real>(chart_width, left + width * static_cast<Real>(count) + 8);
  Real y = 6;
  std::string names = map.column_name.empty() ? "" : map.column_name + " →";
  if (!map.rows.empty()) names = map.row_name + " ↓, " + names;
  std::string body;
  if (!names.empty()) body += styled_text(8, y + 12, "start", "symbol", shorten(names, 54)), y += 20;
  for (std::size_t first = 0; first < map.columns.size(); first += count) {
    body += draw_block(map, first, std::min(count, map.columns.size() - first), left, width, y);
    y += 8;
  }
  y += 6;
  body += draw_legend(map, full, y);
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" class="chart" viewBox="0 0 {0:.0f} {1:.0f}" width="{0:.0f}" height="{1:.0f}" role="img" aria-label="{2}"><rect class="paper" width="{0:.0f}" height="{1:.0f}"/>{3}</svg>)",
      full, y, escape_xml(map.label), body);
}

}  // namespace courant::report
