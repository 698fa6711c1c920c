#pragma once
#include "elements/solid/formulation.hpp"
#include "elements/solid/solid_cards.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// Of a part of solids, by its ELFORM; that of 1 where there is no section, or none that is there.
const SolidFormulation& solid_formulation(const Deck& deck, const ModelPart& part);

/// Checks that each part with solids has a section with a formulation that is there. Sections that no such
/// part names may be of any kind.
void check_solid_sections(const Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace courant
