#pragma once
// What the summary of a run takes from the simulation at its end.
#include <optional>

#include "app/check/units.hpp"
#include "app/run/simulation.hpp"
#include "output/summary.hpp"

namespace courant {

/// The most probable units of its deck; nothing where no common system fits.
std::optional<UnitNames> units_of(const Simulation& simulation);
/// Time, steps, energies, counters, ranges and memory.
void note_end(Summary& summary, Simulation& simulation);
/// Rows of the passes, and what is left of the elapsed time.
void note_times(Summary& summary, const PassTimer& timer);

}  // namespace courant
