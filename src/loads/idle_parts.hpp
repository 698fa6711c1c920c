#pragma once
#include <string>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// Loads in proportion to the mass act on particles and nodes, each of which counts to one part. Of the parts
/// that a card names, those to which none counts, as of springs, whose ends have masses of other parts or of
/// *ELEMENT_MASS: a warning at `field` tells them.
void warn_of_idle_parts(const Deck& deck, const Entry& card, const char* field,
                        const std::vector<Index>& parts, const Model& model, const World& world,
                        Diagnostics& diagnostics);

/// The same of *LOAD_GRAVITY_PART.
void check_gravity_of_parts(const Deck& deck, const Model& model, const World& world,
                            Diagnostics& diagnostics);

}  // namespace courant
