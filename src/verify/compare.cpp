#include "verify/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "verify/judge.hpp"
#include "verify/result_files.hpp"

namespace courant {
namespace {

using Row = std::map<std::string, std::string>;  // by the names of the head

/// Cells of a line of a CSV file; quotes may hold commas, and two quotes are one.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"')
      out.back() += line[k++];
    else if (line[k] == '"')
      quoted = !quoted;
    else if (line[k] == ',' && !quoted)
      out.emplace_back();
    else if (line[k] != '\r')
      out.back() += line[k];
  }
  return out;
}

std::vector<Row> rows_of(std::istream& stream) {
  std::vector<Row> out;
  std::string line;
  if (!std::getline(stream, line)) return out;
  const std::vector<std::string> names = cells_of(line);
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != names.size()) continue;
    Row& row = out.emplace_back();
    for (std::size_t k = 0; k < cells.size(); ++k) row[names[k]] = cells[k];
  }
  return out;
}

std::optional<Real> number(const std::string& text) {
  Real value = 0;
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string name_of(Row& row) {
  std::string out = row["case"] + ": " + row["setting"];
  if (!row["resolution"].empty()) out += ", " + row["resolution"];
  return out;
}

std::string key_of(Row& row) {
  return row["case"] + '\n' + row["setting"] + '\n' + row["resolution"] + '\n' + row["observation"];
}

class Comparer {
 public:
  void compare(Row& before, Row& now) {
    ++out_.compared;
    const std::string run = name_of(now);
    const std::string observation = now["observation"].empty() ? run : run + ", " + now["observation"];
    if (runs_.insert(run).second) compare_runs(run, before, now);
    if (before["check"] != now["check"] && !before["check"].empty() && !now["check"].empty() &&
        before["as_required"] == now["as_required"])
      tell(fmt::format("{}: check {}, was {}", observation, now["check"], before["check"]),
           now["check"] == "missed");
    if (before["check"] == "met" && now["check"] == "missed") out_.regressed = true;
    const auto old_error = number(before["error"]), error = number(now["error"]);
    if (old_error.has_value() != error.has_value())
      tell(fmt::format("{}: {}", observation,
                       error ? fmt::format("error {:.3g}, there was none", *error)
                             : fmt::format("no error any more ({}), was {:.3g}", now["why"], *old_error)),
           !error);
    if (old_error && error && std::abs(*error - *old_error) > 0.05 * *old_error + 1e-12)
      tell(fmt::format("{}: error {:.4g}, was {:.4g}", observation, *error, *old_error), *error > *old_error);
  }
  void gone(Row& row) {
    tell(name_of(row) + (row["observation"].empty() ? "" : ", " + row["observation"]) + ": no longer there",
         false);
  }
  void added(Row& row) {
    tell(name_of(row) + (row["observation"].empty() ? "" : ", " + row["observation"]) + ": new", false);
  }
  Comparison take() { return std::move(out_); }

 private:
  void tell(std::string text, bool worse) { out_.lines.push_back({std::move(text), worse}); }

  void compare_runs(const std::string& run, Row& before, Row& now) {
    const bool was = before["as_required"] == "yes", is = now["as_required"] == "yes";
    if (before["verdict"] != now["verdict"])
      tell(fmt::format("{}: {}, was {}{}{}", run, now["verdict"], before["verdict"],
                       now["reason"].empty() ? "" : ": ", now["reason"]),
           rank(now["verdict"]) > rank(before["verdict"]));
    else if (was != is)
      tell(fmt::format("{}: {}, which is {} allowed", run, now["verdict"], is ? "now" : "no longer"), !is);
    if (was && !is) out_.regressed = true;
    const Real old_cost = cost(before), new_cost = cost(now);
    if (old_cost > 0 && new_cost > 0 && std::abs(new_cost - old_cost) > 0.3 * old_cost)
      tell(
          fmt::format("{}: {:.0f} ns of CPU time per particle and step, was {:.0f}", run, new_cost, old_cost),
          new_cost > old_cost);
  }
  static int rank(const std::string& verdict) {
    for (const Verdict v : all_verdicts)
      if (verdict == word_for(v)) return static_cast<int>(v);
    return -1;
  }
  /// ns of CPU time per particle and step; 0 if the run was too short to tell.
  static Real cost(Row& row) {
    constexpr Real shortest = 0.2;  // s
    const Real seconds = number(row["cpu_seconds"]).value_or(0),
               steps = number(row["particle_steps"]).value_or(0);
    return seconds >= shortest && steps > 0 ? 1e9 * seconds / steps : 0;
  }

  Comparison out_;
  std::set<std::string> runs_;
};

}  // namespace

std::optional<Comparison> compare_with(const SuiteResult& result, const std::filesystem::path& earlier,
                                       Diagnostics& diagnostics) {
  std::ifstream file(earlier);
  std::istringstream text(results_csv(result));
  std::vector<Row> before = rows_of(file), now = rows_of(text);
  if (before.empty() || !before.front().contains("as_required") || !before.front().contains("observation")) {
    diagnostics.error({earlier.string()},
                      "not a results.csv of an earlier `courant verify`, or an empty one");
    return std::nullopt;
  }
  Comparer comparer;
  std::map<std::string, Row*> old;
  for (Row& row : before) old[key_of(row)] = &row;
  std::set<std::string> cases, seen;
  for (Row& row : now) {
    cases.insert(row["case"]);
    seen.insert(key_of(row));
    if (const auto found = old.find(key_of(row)); found != old.end())
      comparer.compare(*found->second, row);
    else
      comparer.added(row);
  }
  for (Row& row : before)  // cases that were not asked for this time are not gone
    if (cases.contains(row["case"]) && !seen.contains(key_of(row))) comparer.gone(row);
  return comparer.take();
}

}  // namespace courant
