#include "app/run_deck.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "app/run/restart.hpp"
#include "parallel/parallel.hpp"
#include "parallel/thread_limit.hpp"

namespace courant {

namespace {

RunResult refused(int code, std::string text) {
  return {.exit_code = code, .error = std::move(text), .summary = {}};
}

/// Null where the deck is wrong; `result` says so.
std::unique_ptr<Simulation> built(RunCall& call, const DeckRecord* before, RunResult& result) {
  Diagnostics diagnostics;
  auto simulation = Simulation::build(call.deck, call.read, diagnostics, before);
  if (call.messages) call.messages(diagnostics);
  if (!simulation)
    result = refused(exit_input, fmt::format("{} error{}; nothing was run, nothing written\n",
                                             diagnostics.errors(), diagnostics.errors() == 1 ? "" : "s"));
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == Severity::warning) call.options.warnings.push_back(d.text());
  return simulation;
}

/// The same deck in the phase of its relaxation, whose warnings are those of the run.
std::unique_ptr<Simulation> built_relaxing(const RunCall& call, RunResult& result) {
  Diagnostics diagnostics;
  auto relaxing = Simulation::build(call.deck, call.read, diagnostics, nullptr, RunPhase::relaxation);
  if (!relaxing) result = refused(exit_input, diagnostics.text());
  return relaxing;
}

RunResult result_of(Summary summary) {
  RunResult out{.exit_code = exit_ok, .error = {}, .summary = std::move(summary)};
  const Summary& s = out.summary;
  if (s.termination == "error") {
    out.error = fmt::format("error: {}\n", s.reason);
    if (!s.advice.empty()) out.error += fmt::format("  hint: {}\n", s.advice);
  } else if (s.verdict == "broken") {
    out.error = "error: the run ended, but its results cannot be trusted (verdict: broken)\n";
    for (const std::string& reason : s.verdict_reasons) out.error += fmt::format("  {}\n", reason);
  }
  if (!out.error.empty()) out.exit_code = exit_run;
  return out;
}

}  // namespace

RunResult run_deck(RunCall& call) {
  RunOptions& options = call.options;
  if (!std::isfinite(options.until))
    return refused(exit_input, fmt::format("error: --until {}: expected a time\n", options.until));
  if (const std::string why = why_not_threads(call.threads); !why.empty())
    return refused(exit_other, fmt::format("error: {}\n", why));
  set_threads(call.threads);
  options.choose_threads = call.threads == 0;
  try {
    std::optional<Restart> restart;
    if (!call.restart.empty()) restart = open_restart(call.restart);
    RunResult result;
    const auto simulation = built(call, restart ? &restart->deck : nullptr, result);
    if (!simulation) return result;
    if (const std::string why = simulation->why_not_until(options.until); !why.empty())
      return refused(exit_input, fmt::format("error: --until {:g}: {}\n  hint: {}\n", options.until, why,
                                             Simulation::how_until));
    std::unique_ptr<Simulation> relaxing;
    if (simulation->relaxation().asked && !restart && !(relaxing = built_relaxing(call, result)))
      return result;
    options.restart = restart ? &*restart : nullptr, options.relaxing = relaxing.get();
    if (call.before_run) call.before_run();
    try {
      return result_of(run(*simulation, call.deck, options));
    } catch (const RestartError& error) {
      return refused(exit_input,
                     fmt::format("error: {}\n  hint: use the program that wrote the file, with the requests "
                                 "for output of the run so far\n",
                                 error.what()));
    }
  } catch (const RestartError& error) {
    return refused(exit_input, fmt::format("error: {}\n", error.what()));
  } catch (const OutputError& error) {  // the folder could not be set up: nothing was run
    return refused(exit_input, fmt::format("error: {}\n", error.what()));
  }
}

}  // namespace courant
