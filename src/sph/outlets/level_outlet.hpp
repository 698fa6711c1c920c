#pragma once
#include <span>

#include "sph/sph.hpp"

namespace courant {

/// Adds a force, a time limit and an energy term for each *COURANT_LEVEL_OUTLET; false where there is none.
/// Call while `world` has its particles. `planes`: no box may reach behind one of them.
bool add_level_outlets(const Deck& deck, const Model& model, const SphSettings& settings,
                       std::span<const GhostPlane> planes, World& world, Diagnostics& diagnostics);

}  // namespace courant
