#pragma once
#include <vector>

#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// Fills places, velocities, ids and parts of world.nodes: the nodes that shells and solids use, and `more`
/// that are no particles, in the order of the model. Returns the node of the world of each node of the model,
/// -1 where it has none.
std::vector<Index> build_nodes(const Model& model, const std::vector<Index>& more, World& world);

}  // namespace courant
