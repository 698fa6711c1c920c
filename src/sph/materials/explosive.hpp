#pragma once
#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "sph/materials/material_cards.hpp"
#include "state/shared_fields.hpp"
#include "state/world.hpp"

namespace courant {

/// Particles: the share whose products have a pressure, 1 where the material is no explosive. Only scenes
/// with explosives have it.
inline const SharedField<Real> burn_fraction{{.name = "burn_fraction", .dimension = "-", .output = true}};

struct MatHighExplosive : MatHighExplosiveFields {
  /// V of Chapman and Jouguet, 1 - PCJ/(RO D^2). [-]
  Real cj() const { return 1 - pcj / (ro * d * d); }
  /// Refuses BETA that are not there, PCJ beyond what D allows, and strength before the detonation.
  void check(const Deck& deck, Diagnostics& diagnostics) const;
};

/// Adds the field of explosives, and the pass that advances it, where there are any.
void add_burn(World& world, const Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace courant
