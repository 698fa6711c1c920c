#include "app/report/run_summary.hpp"

#include <cmath>

#include "app/run/resources.hpp"
#include "elements/element_laws.hpp"

namespace courant {

std::optional<UnitNames> units_of(const Simulation& s) {
  std::vector<Real> speeds;
  for (const PartRange& part : s.guard().ranges()) speeds.push_back(part.c0);
  for (const auto& group : s.world().groups)
    if (group->pushes) speeds.push_back(s.get<ElementLaws>().speed(group->part));
  return guess_units(s.unit_facts(), speeds);
}

void note_end(Summary& y, Simulation& s) {
  const World& world = s.world();
  y.ranges = s.guard().ranges();
  y.time = s.clock().t, y.steps = s.clock().cycle;
  y.active_particles = world.particles.active;
  y.peak_memory_bytes = peak_memory();
  y.energy = world.energy;
  y.counters = world.counters;
  y.maxima = world.maxima;
  y.leaked_particles = y.counters.contains("leaked_particles") ? y.counters.at("leaked_particles") : 0;
  y.max_penetration = y.maxima.contains("max_penetration") ? y.maxima.at("max_penetration") : 0;
  if (!std::isfinite(y.dt_min)) y.dt_min = 0;
  if (s.has_particles()) y.counters["neighbour_rebuilds"] = s.neighbours().rebuilds();
  if (const auto units = units_of(s))
    y.mass = units->mass, y.length = units->length, y.time_unit = units->time;
}

void note_times(Summary& summary, const PassTimer& timer) {
  double sum = 0;
  for (const auto& row : timer.table()) {
    summary.passes.push_back({row.name, row.seconds, row.calls});
    sum += row.seconds;
    if (row.name == "output") summary.output.seconds = row.seconds;
  }
  summary.passes.push_back({"rest", summary.read_seconds + summary.wall_seconds - sum, 1});
}

}  // namespace courant
