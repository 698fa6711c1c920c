#include "sph/core/pair_volumes.hpp"

#include <algorithm>

#include "parallel/parallel.hpp"
#include "sph/sph.hpp"

namespace courant {

PairVolumes::PairVolumes(World& world) {
  FieldSet& fields = world.particles.fields;
  const char* names[] = {"volume", "other_volume"};
  for (int k = 0; k < 2; ++k)
    fields_[k] = &fields.add<Real>({.name = names[k], .dimension = "L3", .restart = false, .exchange = true});
}

void PairVolumes::declare(const World& world, Accesses& a) const {
  a.reads(world.particles.m).reads(world.particles.rho).writes(next_);
  a.in_finish().writes(now_);
}

void PairVolumes::block(World& world, const Clock&, Index begin, Index end) {
  const Real *m = world.particles.m.data(), *rho = world.particles.rho.data();
  Real* V = fields_[1 - current_]->data();
  for (Index i = begin; i < end; ++i) V[i] = m[i] / rho[i];
}

void PairVolumes::pretend(const Array<Real>& volumes) {
  std::copy(volumes.begin(), volumes.end(), fields_[current_]->data());
}

void PairVolumes::set_ghosts(Index first, Index last, Real volume) {
  for (Field<Real>* field : fields_) std::fill(field->data() + first, field->data() + last, volume);
}

// Also of the halo: its density does not change, so no pass writes it in between.
void PairVolumes::fill(World& world) {
  const Particles& p = world.particles;
  const Real *m = p.m.data(), *rho = p.rho.data();
  Real *V = fields_[0]->data(), *W = fields_[1]->data();
  for_each(p.moving, [=](Index i) { V[i] = W[i] = m[i] / rho[i]; });
}

std::shared_ptr<PairVolumes> make_pair_volumes(World& world) {
  return world.passes.add(std::make_shared<PairVolumes>(world));
}

}  // namespace courant
