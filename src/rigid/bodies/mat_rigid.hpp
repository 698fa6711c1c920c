#pragma once
#include <optional>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "rigid/bodies/rigid_cards.hpp"

namespace courant {

/// The one of this id; null where there is none.
const MatRigid* mat_rigid_of(const Deck& deck, Id mid);
/// The axes of LCO or A1 to V3, as columns; nothing where it gives none.
std::optional<Matrix> axes_of_material(const MatRigid& m, const Model& model);

}  // namespace courant
