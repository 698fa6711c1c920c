#pragma once
#include <memory>

#include "sph/materials/materials.hpp"
#include "sph/sph.hpp"

namespace courant {

/// Adds a pass for each *COURANT_FROZEN_OUTLET; false where there is none. Call after the passes of SPH,
/// whose ledger must see particles as they leave the box.
bool add_frozen_outlets(const Deck& deck, const Model& model, const SphSettings& settings,
                        const std::vector<PartMaterial>& materials,
                        std::shared_ptr<const Neighbours> neighbours, World& world, Diagnostics& diagnostics);

}  // namespace courant
