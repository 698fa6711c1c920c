#include "app/run/run_ends.hpp"
#include "app/run/app_cards.hpp"

#include <fmt/format.h>

#include "base/run_error.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<ControlCpu> control_cpu{control_cpu_table()};

}  // namespace

RunEnds::RunEnds(Simulation& simulation, const std::atomic<bool>* stop, const Program* program)
    : s_(simulation),
      stop_(stop),
      program_(program),
      endings_(simulation.world().passes.all<const Ending>()) {
  for (const ControlCpu& card : simulation.deck().all<ControlCpu>()) most_cpu_ = card.cputim;
}

std::optional<RunEnd> RunEnds::reached(double cpu) const {
  const Clock& clock = s_.clock();
  const Id endcyc = s_.model().endcyc;
  if (auto end = called_off(cpu)) return end;
  stop_without_progress(clock);
  if (endcyc > 0 && clock.cycle >= endcyc) return RunEnd{.reason = "termination cycle reached"};
  for (const Ending* ending : endings_)
    if (auto why = ending->ended(s_.world(), clock)) return RunEnd{.reason = *std::move(why)};
  return std::nullopt;
}

std::optional<RunEnd> RunEnds::called_off(double cpu) const {
  const Real t = s_.clock().t;
  if (stop_ && stop_->load())
    return RunEnd{.reason = fmt::format("stopped by a signal at time {:.6g}", t), .interrupted = true};
  if (program_ && program_->called_off())
    return RunEnd{.reason = fmt::format("stopped by the program at time {:.6g}", t), .interrupted = true};
  if (most_cpu_ > 0 && cpu >= most_cpu_)
    return RunEnd{
        .reason = fmt::format("CPUTIM = {:g} s of *CONTROL_CPU are spent at time {:.6g}", most_cpu_, t),
        .interrupted = true,
        .wants_restart = true};
  return std::nullopt;
}

void RunEnds::stop_without_progress(const Clock& clock) const {
  constexpr int interval = 64;       // steps from look to look: a step may be short once, as DTINIT
  constexpr Real most_steps = 1e14;  // years of computing
  const Real left = s_.model().endtim - clock.t;
  if (s_.model().endcyc > 0 || !endings_.empty() || most_cpu_ > 0)
    return;  // ENDTIM may be out of reach on purpose
  if (clock.cycle == 0 || clock.cycle % interval != 0 || !(left > most_steps * clock.dt_old)) return;
  throw RunError(fmt::format("the run gets nowhere: steps of {:.4g} at time {:.6g}, cycle {}, where {:.4g} "
                             "is left to ENDTIM",
                             clock.dt_old, clock.t, clock.cycle, left),
                 StopCause::step_size);
}

}  // namespace courant
