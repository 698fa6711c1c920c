#include "verify/result_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verify/judge.hpp"

namespace courant {
namespace {

using Row = std::vector<std::string>;

/// Length on a terminal: bytes that begin a character.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// Columns as wide as their longest entry, the first `left` of them flush left.
std::string aligned(const std::vector<Row>& rows, std::size_t left) {
  std::vector<std::size_t> width;
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k == width.size()) width.push_back(0);
      width[k] = std::max(width[k], width_of(row[k]));
    }
  std::string out;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string blank(width[k] - width_of(row[k]), ' ');
      line += k == 0 ? "  " : "  ";
      line += k < left ? row[k] + blank : blank + row[k];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

std::string number(const std::optional<Real>& value, const char* otherwise = "-") {
  return value ? fmt::format("{:.4g}", *value) : otherwise;
}

std::string percent(Real error) {
  if (error == 0) return "0 %";
  const Real p = 100 * error;
  return p >= 0.01 && p < 1e4 ? fmt::format("{:.3g} %", p) : fmt::format("{:.1e}", error);
}

std::string cpu(double seconds) {
  return seconds < 100 ? fmt::format("{:.2f}", seconds) : fmt::format("{:.0f}", seconds);
}

std::string memory(std::int64_t bytes) {
  return fmt::format("{:.0f} MB", static_cast<double>(bytes) / 1e6);
}

std::string order_of(const CaseResult& c, const RunResult& run, const std::string& observation) {
  for (const MeasuredOrder& m : c.orders)
    if (m.setting == run.setting && m.observation == observation)
      return m.order ? fmt::format("{:.2f}", *m.order) : "-";
  return "-";
}

bool is_compared(const SuiteObservation& o) {
  return o.reference.kind != SuiteReference::Kind::none;
}

/// Whether the run is the last of its setting: there the order of convergence stands.
bool ends_setting(const CaseResult& c, std::size_t k) {
  return k + 1 == c.runs.size() || c.runs[k + 1].setting != c.runs[k].setting;
}

std::string accuracy_table(const CaseResult& c) {
  Row head = {"setting"};
  if (!c.definition.resolution.empty()) head.push_back(c.definition.resolution);
  for (const char* name : {"particles", "steps", "cpu s", "memory"}) head.emplace_back(name);
  for (const SuiteObservation& o : c.definition.observations) {
    if (o.take != "curve") head.push_back(o.name + (o.unit.empty() ? "" : " [" + o.unit + "]"));
    if (is_compared(o)) head.push_back(o.take == "curve" ? o.name + ": error" : "error");
    if (is_compared(o) && !c.definition.size.empty()) head.emplace_back("order");
  }
  std::vector<Row> rows = {head};
  for (std::size_t k = 0; k < c.runs.size(); ++k) {
    const RunResult& run = c.runs[k];
    Row row = {run.setting};
    if (!c.definition.resolution.empty()) row.push_back(run.resolution);
    row.push_back(fmt::format("{}", run.particles));
    row.push_back(fmt::format("{}", run.steps));
    row.push_back(cpu(run.cpu_seconds));
    row.push_back(memory(run.peak_memory_bytes));
    for (std::size_t o = 0; o < run.observed.size(); ++o) {
      const SuiteObservation& definition = c.definition.observations[o];
      const Observed& observed = run.observed[o];
      if (definition.take != "curve") row.push_back(number(observed.value));
      if (is_compared(definition)) row.push_back(observed.error ? percent(*observed.error) : "-");
      if (is_compared(definition) && !c.definition.size.empty())
        row.push_back(ends_setting(c, k) ? order_of(c, run, definition.name) : "");
    }
    rows.push_back(std::move(row));
  }
  return aligned(rows, 1);
}

std::string stability_table(const CaseResult& c) {
  Row head = {"run", "verdict", "required", "particles", "steps", "cpu s"};
  for (const SuiteObservation& o : c.definition.observations)
    if (o.take != "curve") head.push_back(o.name);
  std::vector<Row> rows = {head};
  for (const RunResult& run : c.runs) {
    Row row = {run.setting,
               word_for(run.verdict),
               run.as_required ? "yes" : "NO",
               fmt::format("{}", run.particles),
               fmt::format("{}", run.steps),
               cpu(run.cpu_seconds)};
    for (std::size_t o = 0; o < run.observed.size(); ++o)
      if (c.definition.observations[o].take != "curve") row.push_back(number(run.observed[o].value));
    rows.push_back(std::move(row));
  }
  return aligned(rows, 3);
}

/// A letter for every verdict, the first swept parameter across, the second downwards.
std::string map_text(const CaseResult& c) {
  const auto& sweep = c.definition.stability->sweep;
  if (sweep.size() != 2 || c.definition.settings.size() > 1) return {};
  const auto& [name, values] = sweep[0];
  const auto& [name2, values2] = sweep[1];
  if (c.runs.size() != values.size() * values2.size()) return {};
  std::vector<Row> rows = {{fmt::format("{} \\ {}", name2, name)}};
  for (const std::string& value : values) rows[0].push_back(value);
  for (std::size_t j = 0; j < values2.size(); ++j) {
    Row row = {values2[j]};
    for (std::size_t i = 0; i < values.size(); ++i)
      row.emplace_back(1, "SDXRB"[static_cast<std::size_t>(c.runs[i * values2.size() + j].verdict)]);
    rows.push_back(std::move(row));
  }
  return "  map: S stable, D degraded, X stopped, R refused, B broken\n" + aligned(rows, 1);
}

/// What the numbers in the table do not say.
std::string remarks(const CaseResult& c) {
  std::string out;
  for (const RunResult& run : c.runs) {
    const std::string name =
        fmt::format("  {}{}{}: ", run.setting, run.resolution.empty() ? "" : ", ", run.resolution);
    if (run.verdict != Verdict::stable && run.verdict != Verdict::degraded)
      out += fmt::format("{}{}: {}\n", name, word_for(run.verdict), run.reason);
    for (const std::string& exceeded : run.exceeded) out += name + exceeded + "\n";
    if (run.verdict == Verdict::stable)
      for (const Observed& observed : run.observed)
        if (!observed.why.empty()) out += fmt::format("{}{}: {}\n", name, observed.name, observed.why);
  }
  return out;
}

std::string check_text(const CaseResult& c, const BoundCheck& check) {
  std::string out = fmt::format("{}: {}", c.definition.name, check.setting);
  if (!check.observation.empty()) out += ", " + check.observation;
  out += ": " + check.what;
  if (check.what == "error at most")
    out += fmt::format(" {}: {}", percent(check.bound), percent(check.measured));
  if (check.what == "order at least") out += fmt::format(" {:g}: {:.2f}", check.bound, check.measured);
  if (c.definition.stability) out += " is required";
  return out;
}

}  // namespace

std::string case_table(const CaseResult& c) {
  std::string out = fmt::format("{}: {}\n", c.definition.name, c.definition.title);
  if (c.definition.stability) return out + stability_table(c) + map_text(c) + remarks(c);
  return out + accuracy_table(c) + remarks(c);
}

std::string checks_text(const SuiteResult& result) {
  std::string missed;
  int met = 0, all = 0;
  for (const CaseResult& c : result.cases) {
    for (const BoundCheck& check : c.checks) {
      ++all;
      met += check.met;
      if (!check.met) missed += "  MISSED  " + check_text(c, check) + "\n";
    }
  }
  if (all == 0) return "The suite states no bounds.\n";
  return missed + fmt::format("{} of {} checks met, {} missed\n", met, all, all - met);
}

}  // namespace courant
