#pragma once
// The outputs that a deck requests, and their times.
#include "app/run/simulation.hpp"
#include "output/ascii/ascii.hpp"
#include "output/messag.hpp"
#include "output/output_schedule.hpp"

namespace courant {

HistoryRequests history_requests(const Simulation& simulation);
/// When field states are due in a run to `end` [T].
OutputSchedule field_schedule(const Simulation& simulation, Real end);
/// Energy and step at the start, and what sets it.
void tell_first_step(const World& world, const Clock& clock, const std::string& who, Messag& messag);
/// Each element that fails at t^n, in messag; the first of them are passed on.
void tell_failures(const World& world, const Clock& clock, Messag& messag);

}  // namespace courant
