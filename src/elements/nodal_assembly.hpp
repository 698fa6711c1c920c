#pragma once
#include <memory>

#include "state/world.hpp"

namespace courant {

/// Assembly of nodal forces, and of moments on rotations: a gather over the nodes of what elements of all
/// groups left for them, in a fixed order: the same bits on any number of threads. Call when all groups are
/// built.
std::shared_ptr<Force> make_nodal_assembly(World& world);

}  // namespace courant
