#pragma once
// What all points do in a step.
#include <memory>

#include "state/points.hpp"
#include "state/world.hpp"

namespace courant {

/// f = 0, before anybody adds to it.
std::shared_ptr<Rate> make_clear_forces(Points points);
/// v += f/m dt_mean, x += v dt; rim particles move with their velocity; points that follow something else stay.
std::shared_ptr<Motion> make_point_motion(Points points);

}  // namespace courant
