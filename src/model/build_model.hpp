#pragma once
// From cards to the model: references are resolved and checked, initial velocities and constraints applied.
#include "base/diagnostic.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// Of a node [L]: powers of distances, and numbers of 4 bytes in field files, hold what is less.
inline constexpr Real largest_coordinate = 1e30;

/// All faults go to `diagnostics` (at most 100 of them); the model is of use only if there is none.
/// Initial velocities: INITIAL_VELOCITY in deck order, then _GENERATION in deck order, then _NODE.
Model build_model(const Deck& deck, Diagnostics& diagnostics, RunPhase phase = RunPhase::transient);

/// Sorts the cards of nodes, particles and elements by id, and those of one id stay in deck order, so that
/// the bits of a run do not depend on where a deck has them.
void sort_mesh_cards(Deck& deck);

/// Gives back the cards of nodes and elements, which the model has taken over.
void release_mesh_cards(Deck& deck);

}  // namespace courant
