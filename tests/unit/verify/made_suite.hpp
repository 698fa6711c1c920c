#pragma once
// Results of a suite that never ran: numbers from formulas, with everything in them that reports have to cope
// with.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "verify/results.hpp"

namespace courant::made {

inline constexpr Real infinite = std::numeric_limits<Real>::infinity();
inline constexpr Real no_number = std::numeric_limits<Real>::quiet_NaN();

/// A PNG file of 8 x 4 pixels.
inline std::string picture() {
  const std::string hex =
      "89504e470d0a1a0a0000000d49484452000000080000000408020000003cafe9a7000000494944415478da0dc9310100410803"
      "c188410c069041bf36ce0602108399fc4f3b120a94a8d1438b0e194954504935f5a8a58e32f5c704934c338f59e618337f3870"
      "e2c60f2f3e6cfc0192632ed5249431da0000000049454e44ae426082";
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return bytes;
}

inline SuiteObservation observation(const std::string& name, SuiteReference::Kind kind) {
  SuiteObservation o;
  o.name = name;
  o.reference.kind = kind;
  return o;
}

inline RunResult run(const std::string& setting, const std::string& resolution, double cpu) {
  RunResult r;
  r.setting = setting, r.resolution = resolution;
  r.cpu_seconds = cpu, r.wall_seconds = 0.6 * cpu;
  r.particles = static_cast<std::int64_t>(400 * (1 + cpu)), r.steps = 1200;
  r.particle_steps = r.particles * r.steps, r.peak_memory_bytes = 48'000'000;
  r.termination = "normal";
  return r;
}

inline Observed error(const std::string& name, Real value) {
  Observed o;
  o.name = name, o.found = true, o.error = value;
  return o;
}

/// A run that stopped before there was anything to observe.
inline RunResult stopped(RunResult r, std::size_t observations) {
  r.exit_code = 2, r.termination = "error", r.reason = "runaway energy at t = 0.012 in part 2 <water>";
  r.observed.resize(observations);
  for (Observed& o : r.observed) o.why = "the run stopped at t = 0.012";
  return r;
}

/// Three settings, four resolutions, a number and a curve; one bound is missed.
inline CaseResult wave() {
  CaseResult c;
  SuiteCase& d = c.definition;
  d.name = "wave", d.title = "Standing wave <in> a \"tank\" & more";
  d.about =
      "A wave of small amplitude: period and decay.\n\nThe period follows from the dispersion relation; what "
      "is lost "
      "to viscosity shows in the decay. <script>document.title = 'injected'</script>";
  d.resolution = "n", d.resolutions = {"10", "20", "40", "80"};
  d.observations = {observation("period", SuiteReference::Kind::formula),
                    observation("height", SuiteReference::Kind::csv)};
  d.observations[0].title = "period", d.observations[0].unit = "s", d.observations[0].take = "period";
  d.observations[0].reference.formula = "2*pi/sqrt(g*k*tanh(k*d))",
  d.observations[0].reference.source = "Lamb 1932, art. 228";
  d.observations[0].bound = 0.01, d.observations[0].least_order = 1;
  d.observations[1].title = "height at the wall", d.observations[1].unit = "m";
  d.observations[1].reference.csv = "data/height.csv", d.observations[1].bound = 0.001;
  const std::vector<std::string> settings = {"cubic, h/dx = 1.2", "Wendland C2, h/dx = 1.6",
                                             "cubic, c0 halved"};
  for (std::size_t s = 0; s < settings.size(); ++s) {
    d.settings.push_back({settings[s], {}, {}});
    for (int i = 0; i < 4; ++i) {
      const Real n = 10 * std::pow(2.0, i);
      RunResult r = run(settings[s], d.resolutions[static_cast<std::size_t>(i)],
                        std::pow(n / 10, 3) * (s == 1   ? 0.21
                                               : s == 2 ? 0.05
                                                        : 0.1));
      const Real e = s == 1 ? 3.2 / (n * n) : s == 2 ? 0.01 + 0.4 / n : 0.5 / n;
      Observed period = error("period", e);
      period.value = 1.27 * (1 + e), period.reference = 1.27;
      Observed height = error("height", 3 * e);
      for (int k = 0; k < 200; ++k) {
        const Real t = 0.02 * k;
        height.curve.x.push_back(t),
            height.curve.y.push_back(0.1 * std::exp(-e * t) * std::cos(4.95 * t * (1 - e)));
        if (k % 8 == 0)
          height.curve.reference_x.push_back(t), height.curve.reference_y.push_back(0.1 * std::cos(4.95 * t));
      }
      r.observed = {period, height};
      c.runs.push_back(r);
    }
    c.orders.push_back({settings[s], "period", s == 1 ? 2.0 : s == 2 ? 0.61 : 1.0});
    c.orders.push_back({settings[s], "height", {}});
    c.checks.push_back(
        {settings[s], "period", "error at most", 0.01, c.runs.back().observed[0].error.value(), s != 2});
    c.checks.push_back({settings[s], "period", "order at least", 1, *c.orders[2 * s].order, s != 2});
  }
  c.picture = ReportPicture{picture(), "speed at t = 1 s", "0 m/s", "0.5 m/s"};
  return c;
}

/// Errors that have no place on a logarithmic axis, a run that stopped, and more settings than colours.
inline CaseResult strange() {
  CaseResult c;
  c.definition.name = "strange", c.definition.title = "Strange errors";
  c.definition.resolution = "n";
  c.definition.observations = {observation("mass", SuiteReference::Kind::formula)};
  c.definition.observations[0].bound = 0.1;
  const Real errors[] = {0, no_number, infinite, 0.02, 0.05, 0.004, 0.3, 0.15, 0.06, 0.011};
  for (int i = 0; i < 10; ++i) {
    c.runs.push_back(run("setting " + std::to_string(i + 1), "20", 0.3 * (i + 1)));
    c.runs.back().observed = {error("mass", errors[i])};
  }
  c.runs.push_back(stopped(run("setting 11", "20", 0.01), 1));
  c.runs.push_back(run("without time", "20", 0));
  c.runs.back().observed = {error("mass", 0.01)};
  return c;
}

inline CaseResult one_run() {
  CaseResult c;
  c.definition.name = "one", c.definition.title = "One run";
  c.definition.observations = {observation("mass", SuiteReference::Kind::formula)};
  c.runs = {run("", "", 1.5)};
  c.runs[0].observed = {error("mass", 0.012)};
  return c;
}

inline CaseResult no_reference() {
  CaseResult c = one_run();
  c.definition.name = "free", c.definition.title = "No reference";
  c.definition.observations = {observation("kinetic", SuiteReference::Kind::none)};
  Observed o;
  o.name = "kinetic", o.found = true;
  o.curve.x = {0, 1, 2, 3}, o.curve.y = {0, 1, no_number, 2};
  c.runs[0].observed = {o};
  return c;
}

inline CaseResult all_stopped() {
  CaseResult c = one_run();
  c.definition.name = "stopped", c.definition.title = "All runs stopped";
  c.runs = {stopped(run("a", "10", 1), 1), stopped(run("b", "10", 2), 1)};
  c.checks = {{"a", "mass", "error at most", 0.1, no_number, false}};
  return c;
}

/// Verdicts over one or two swept parameters.
inline CaseResult stability(std::size_t columns, std::size_t rows) {
  CaseResult c;
  c.definition.name = "map" + std::to_string(columns) + "x" + std::to_string(rows);
  c.definition.title = "Where it breaks, " + std::to_string(columns) + " by " + std::to_string(rows);
  SuiteStability stability;
  stability.sweep = {{"tssfac", {}}};
  for (std::size_t i = 0; i < columns; ++i) stability.sweep[0].second.push_back("0." + std::to_string(i + 1));
  if (rows > 0) stability.sweep.push_back({"scale", {}});
  for (std::size_t i = 0; i < rows; ++i)
    stability.sweep[1].second.push_back("1e" + std::to_string(static_cast<int>(i) - 3));
  for (std::size_t k = 0; k < columns * std::max<std::size_t>(rows, 1); ++k) {
    const std::size_t i = k % columns, j = k / columns;
    RunResult r = run("", "", 0.1);
    r.parameters["tssfac"] = stability.sweep[0].second[i], r.setting = "tssfac = " + r.parameters["tssfac"];
    if (rows > 0)
      r.parameters["scale"] = stability.sweep[1].second[j], r.setting += ", scale = " + r.parameters["scale"];
    const std::size_t badness = 10 * (i + j) / (columns + rows);
    r.verdict = badness < 4   ? Verdict::stable
                : badness < 6 ? Verdict::degraded
                : badness < 8 ? Verdict::stopped
                : badness < 9 ? Verdict::refused
                              : Verdict::broken;
    r.as_required = r.verdict != Verdict::broken;
    if (r.verdict == Verdict::degraded) r.exceeded = {"growth 0.03 > 0.01"};
    if (r.verdict == Verdict::stopped) r = stopped(r, 0);
    Observed o;
    o.name = "ratio", o.found = true, o.value = 1 + 0.01 * static_cast<Real>(k);
    if (r.verdict <= Verdict::degraded) r.observed = {o};
    c.runs.push_back(r);
    c.checks.push_back({r.setting, "", "verdict allowed", 1, r.as_required ? 1.0 : 0.0, r.as_required});
  }
  c.definition.stability = stability;
  return c;
}

inline SuiteResult suite(std::vector<CaseResult> cases) {
  SuiteResult s;
  s.suite.file = "suites/made.yaml", s.suite.title = "Made <suite>";
  s.suite.about = "Numbers from formulas.";
  s.version = "0.1.0 (release)", s.machine = "a processor, 2 cores, Debian 12",
  s.date = "2026-01-02T03:04:05Z";
  s.wall_seconds = 754, s.jobs = 2;
  s.cases = std::move(cases);
  return s;
}

inline SuiteResult whole_suite() {
  return suite({wave(), strange(), one_run(), no_reference(), all_stopped(), stability(13, 6),
                stability(12, 0), stability(5, 4), stability(10, 9)});
}

}  // namespace courant::made
