#pragma once
// Particles whose material has strength: stress from the rate of strain.
#include <limits>
#include <memory>

#include "sph/sph.hpp"

namespace courant {

/// Instead of infinity, which no field may hold. [M/LT2]
inline constexpr Real no_cutoff = std::numeric_limits<Real>::lowest();

/// *COURANT_ARTIFICIAL_STRESS, and what cannot be beside strength: refused by name. Behind all other
/// settings.
void read_strength(const Deck& deck, const Model& model, SphSettings& settings, Diagnostics& diagnostics);

/// Adds what parts with strength need: the spin to the rates, the stress to the laws; where the settings ask
/// for it, the artificial stress. Behind equations of state and viscous stress.
void add_strength(const SphSettings& settings, World& world, std::shared_ptr<Neighbours> neighbours,
                  std::shared_ptr<PairVolumes> volumes);
void add_artificial_stress(const SphSettings& settings, World& world, std::shared_ptr<Neighbours> neighbours,
                           std::shared_ptr<PairVolumes> volumes);

}  // namespace courant
