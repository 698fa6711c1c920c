#pragma once
// Stages of steps between outer steps (state/subcycle.hpp).
#include <string>
#include <vector>

#include "state/subcycle.hpp"
#include "time/schedule.hpp"

namespace courant {

/// Those up to the choice of dt, without slow passes; the stages of motion have none.
std::vector<StagePlan> make_inner_forces(const World& world);

/// Which pass of each step changes what slow passes leave to the next outer step; empty: none does.
std::string conflict_with_slow(const World& world, const Subcycle& subcycle);

}  // namespace courant
