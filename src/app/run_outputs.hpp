#pragma once
// Which outputs a deck asks of a run, and when.
#include "app/simulation.hpp"
#include "output/ascii.hpp"
#include "output/output_schedule.hpp"

namespace courant {

HistoryRequests history_requests(const Simulation& simulation);
/// When field states are due in a run to `end` [T].
OutputSchedule field_schedule(const Simulation& simulation, Real end);

}  // namespace courant
