#pragma once
// What all points do in a step.
#include <memory>

#include "state/points.hpp"
#include "state/world.hpp"

namespace courant {

/// f = 0, before all additions.
std::shared_ptr<Rate> make_clear_forces(Points points);
/// v += f/m dt_mean, x += v dt; halo particles move with their velocity; points that follow something else
/// stay.
std::shared_ptr<Motion> make_point_motion(Points points);
/// The kinetic energy of points that follow nothing, for the ledger.
std::shared_ptr<EnergyTerm> make_kinetic_energy(Points points);

}  // namespace courant
