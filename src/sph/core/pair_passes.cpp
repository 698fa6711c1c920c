#include "sph/core/pair_passes.hpp"

namespace courant {

PairPasses make_plain_passes(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry,
                             std::shared_ptr<PairVolumes> volumes) {
  PairPasses out{{make_rates(s, world, geometry, volumes)}, {make_forces(s, world, geometry, volumes)}};
  if (!geometry->once()) return out;
  out.rates.push_back(make_rates_reduction(s, world, geometry, volumes));
  out.forces.push_back(make_forces_reduction(s, world, geometry, volumes));
  return out;
}

PairPasses make_pair_passes(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                            std::shared_ptr<PairVolumes> volumes) {
  if (s.geometry_eps > 0) return make_frozen_passes(s, world, std::move(neighbours), std::move(volumes));
  return make_plain_passes(s, world, std::make_shared<PairGeometry>(std::move(neighbours), s.uniform_h),
                           std::move(volumes));
}

}  // namespace courant
