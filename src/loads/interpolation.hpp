#pragma once
// Nodes that go with the weighted mean of others.
#include <set>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// Ids of the dependent nodes of a deck, whose forces others bear.
std::set<Id> interpolated_nodes(const Deck& deck);

/// *CONSTRAINED_INTERPOLATION: adds the passes, and gives the independent nodes the mass of the dependent
/// ones. Call it once masses, bodies and tied contacts are there. `mass_grows`: mass is scaled while the run
/// goes on. Refuses by name: nodes that something else moves or holds, other degrees of freedom than 123 and
/// 123456, weights that differ by axis, independent nodes on one line.
void add_interpolations(const Deck& deck, const Model& model, bool mass_grows, World& world,
                        Diagnostics& diagnostics);

}  // namespace courant
