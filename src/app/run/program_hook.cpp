#include "app/run/program_hook.hpp"

#include <cmath>

#include "app/run/simulation.hpp"

namespace courant {

bool Program::is_due(std::int64_t cycle, Real t, Real dt) {
  if (hook_.every_steps > 0 && cycle % hook_.every_steps == 0) return true;
  if (!(hook_.every_time > 0) || !(next_ * hook_.every_time < t + dt)) return false;
  next_ = std::max(next_ + 1, std::ceil((t + dt) / hook_.every_time));
  return true;
}

void Program::at(Simulation& simulation, Real t, Real dt) {
  if (!hook_.call || called_off_ || !is_due(simulation.clock().cycle, t, dt)) return;
  called_off_ = !hook_.call(simulation);
}

void Program::at_end(Simulation& simulation) {
  if (hook_.call && hook_.every_time > 0 && !called_off_) called_off_ = !hook_.call(simulation);
}

}  // namespace courant
