#pragma once
#include <memory>

#include "keyword/deck.hpp"
#include "laws/fluid/fluid_cards.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

/// *MAT_NULL (*MAT_009): a fluid; pressure from its EOS, tau = 2 MU D'. Shells and beams of it have mass and
/// no stress: YM and PR are for what touches them.
struct MatNull : MatNullFields {
  /// For elements; particles find the viscous stress by sums over pairs. Its
  /// pressure does not fall below PC.
  std::shared_ptr<StrengthLaw> law() const;
  /// For shells and beams: RO, and the moduli for contact.
  std::shared_ptr<StrengthLaw> coat() const;
};

/// Null: the material is another one or missing.
const MatNull* mat_null_of(const Deck& deck, Id mid);

/// Whether a part is of shells or beams of *MAT_NULL, without layers. ModelPart::rigid must be set.
bool is_null(const Deck& deck, const Model& model, const ModelPart& part);

/// Tells of fields that do nothing to shells and beams of *MAT_NULL, once for each material.
void check_null_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace courant
