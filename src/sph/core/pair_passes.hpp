#pragma once
// The passes that sum over pairs of particles: rates, and forces.
#include <memory>
#include <vector>

#include "sph/core/pair_geometry.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/sph.hpp"

namespace courant {

/// In the order in which they run.
struct PairPasses {
  std::vector<std::shared_ptr<Rate>> rates;
  std::vector<std::shared_ptr<Force>> forces;
};

/// What the settings ask for; adds to the motions of `world` what they need. Before the first refresh.
PairPasses make_pair_passes(const SphSettings&, World&, std::shared_ptr<Neighbours>,
                            std::shared_ptr<PairVolumes>);
/// With gradients of the present places, of which as much is kept for the forces as PairGeometry says.
PairPasses make_plain_passes(const SphSettings&, World&, std::shared_ptr<PairGeometry>,
                             std::shared_ptr<PairVolumes>);
/// With gradients that are frozen over steps.
PairPasses make_frozen_passes(const SphSettings&, World&, std::shared_ptr<Neighbours>,
                              std::shared_ptr<PairVolumes>);

// What plain passes are made of. Calls add_viscous_speed:
std::shared_ptr<Rate> make_rates(const SphSettings&, World&, std::shared_ptr<PairGeometry>,
                                 std::shared_ptr<PairVolumes>);
std::shared_ptr<Force> make_forces(const SphSettings&, World&, std::shared_ptr<PairGeometry>,
                                   std::shared_ptr<PairVolumes>);
/// What particles get of pairs that are worked out once (PairGeometry::once).
std::shared_ptr<Rate> make_rates_reduction(const SphSettings&, World&, std::shared_ptr<PairGeometry>,
                                           std::shared_ptr<PairVolumes>);
std::shared_ptr<Force> make_forces_reduction(const SphSettings&, World&, std::shared_ptr<PairGeometry>,
                                             std::shared_ptr<PairVolumes>);

}  // namespace courant
