#pragma once
// Nodes that move as one along some axes.
#include <memory>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// *CONSTRAINED_NODE_SET; nullptr where there is none. Gives the nodes the mean velocity of their masses to
/// start with. Call it once what else moves nodes is known. Refuses by name: sets that are not there, nodes
/// that do not move by their forces, that a support holds or a drive moves along such an axis, or that an
/// earlier set has, and rigid walls beside them.
std::shared_ptr<Constraint> make_node_sets(const Deck& deck, const Model& model, World& world,
                                           Diagnostics& diagnostics);

}  // namespace courant
