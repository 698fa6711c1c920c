#pragma once
#include <memory>

#include "state/world.hpp"

namespace courant {

/// Adds to the force of each node what elements of all groups left for it, in a fixed order: the same bits on
/// any number of threads. Call when all groups are built.
std::shared_ptr<Force> make_corner_gather(const World& world);

}  // namespace courant
