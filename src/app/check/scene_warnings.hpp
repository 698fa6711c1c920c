#pragma once
#include "app/run/simulation.hpp"

namespace courant {

/// Warns of valid but probably unintended input: walls that no particle meets, masses that do not fill the
/// space of particles, particles too far apart to see each other. Of a simulation that has been built, as
/// long as the text of its deck is there.
void warn_of_scene(const Simulation& simulation, Diagnostics& diagnostics);

}  // namespace courant
