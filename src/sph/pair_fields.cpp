#include "sph/pair_fields.hpp"

#include "sph/fields.hpp"
#include "sph/pair_volumes.hpp"
#include "sph/view.hpp"

namespace courant {

void work_out_viscous_speed(const std::vector<PartViscosity>& q, const Particles& p, Index begin, Index end,
                            Real* qc) {
  const Real* c = p.c.data();
  for (Index i = begin; i < end; ++i) qc[i] = q[p.part[i]].q1 * c[i];
}

RateFields::RateFields(const SphSettings& s, Particles& p) : heat_(&sph_fields::dissipation(p)) {
  if (const auto* monaghan = std::get_if<MonaghanViscosity>(&s.viscosity)) {
    viscous_speed_ = &sph_fields::viscous_speed(p);
    q2_ = monaghan->q2;
  }
  if (!s.mu.empty()) strain_ = &sph_fields::strain_rate(p);
}

PairArrays RateFields::arrays(Particles& p, const PairVolumes& volumes) const {
  PairArrays a = particle_arrays(p);
  a.V = volumes.current();
  a.qc = viscous_speed_ ? viscous_speed_->data() : nullptr;
  a.heat = heat_->data();
  a.q2 = quadratic() ? q2_ : 0;
  for (int k = 0; k < 6; ++k) a.strain[k] = strain_ ? strain_->data(k) : nullptr;
  return a;
}

ForceFields::ForceFields(const SphSettings& s, Particles& p) : delta_(s.density_diffusion) {
  if (std::holds_alternative<BulkViscosity>(s.viscosity)) total_pressure_ = &sph_fields::pressure_plus_q(p);
  if (!s.mu.empty()) tau_ = &sph_fields::stress(p);
  if (s.density_diffusion > 0) {
    diffusion_ = &sph_fields::density_diffusion(p);
    potential_ = &sph_fields::potential(p);
  }
}

PairArrays ForceFields::arrays(Particles& p, const PairVolumes& volumes) const {
  PairArrays a = particle_arrays(p);
  a.V = volumes.current();
  a.p = total_pressure_ ? total_pressure_->data() : p.p.data();
  if (diffusion_) {
    a.c = p.c.data();
    a.diffusion = diffusion_->data();
    a.delta = delta_;
    a.potential = potential_->data();
  }
  for (int k = 0; k < 6; ++k) a.tau[k] = tau_ ? tau_->data(k) : nullptr;
  return a;
}

}  // namespace courant
