#include "sph/core/pair_fields.hpp"

#include "sph/core/fields.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"

namespace courant {

void work_out_viscous_speed(const std::vector<PartViscosity>& q, const Particles& p, Index begin, Index end,
                            Real* qc) {
  const Real* c = p.c.data();
  for (Index i = begin; i < end; ++i) qc[i] = q[p.part[i]].q1 * c[i];
}

RateFields::RateFields(const SphSettings& s, Particles& p)
    : kernel_(&any_kernel(s.kernel)), motion_(p), heat_(&sph_fields::dissipation(p)) {
  if (const auto* monaghan = std::get_if<MonaghanViscosity>(&s.viscosity)) {
    viscous_speed_ = &sph_fields::viscous_speed(p);
    q2_ = monaghan->q2;
  }
  if (s.has_viscous_stress() || !s.strength.empty()) strain_ = &sph_fields::strain_rate(p);
}

PairArrays RateFields::arrays(Particles& p, const PairVolumes& volumes) const {
  PairArrays a = particle_arrays(p, motion_.f);
  a.kernel = kernel_;
  for (int k = 0; k < 3; ++k) a.v[k] = motion_.v.data(k);
  a.m = p.m.data(), a.rho = p.rho.data(), a.drhodt = p.drhodt.data();
  a.V = volumes.current();
  a.qc = viscous_speed_ ? viscous_speed_->data() : nullptr;
  a.heat = viscous() ? heat_->data() : nullptr;
  a.q2 = quadratic() ? q2_ : 0;
  for (int k = 0; k < 6; ++k) a.strain[k] = strain_ ? strain_->data(k) : nullptr;
  return a;
}

void RateFields::declare_pairs(const Particles& p, const PairVolumes& volumes, Accesses& a) const {
  a.reads(p.x, Reach::others)
      .reads(motion_.v, Reach::others)
      .reads(p.h, Reach::others)
      .reads(p.m, Reach::others);
  a.reads(volumes.before(), Reach::others).reads_before(p.rho).writes(p.drhodt);
  a.updates(motion_.f);
  if (viscous()) a.reads(*viscous_speed_, Reach::others).writes(*heat_);
  if (strain_) a.writes(*strain_);
}

void RateFields::declare_reduction(const Particles& p, Accesses& a) const {
  a.reads(p.x).reads(motion_.v).reads(p.h).reads(p.m).reads_before(p.rho);
  a.updates(p.drhodt).updates(motion_.f);
  if (viscous()) a.reads(*viscous_speed_).updates(*heat_);
  if (strain_) a.updates(*strain_);
}

ForceFields::ForceFields(const SphSettings& s, Particles& p)
    : kernel_(&any_kernel(s.kernel)), motion_(p), delta_(s.density_diffusion) {
  if (std::holds_alternative<BulkViscosity>(s.viscosity)) total_pressure_ = &sph_fields::pressure_plus_q(p);
  if (s.has_viscous_stress() || !s.strength.empty()) tau_ = &sph_fields::stress(p);
  if (s.density_diffusion > 0) {
    diffusion_ = &sph_fields::density_diffusion(p);
    potential_ = &sph_fields::potential(p);
  }
}

PairArrays ForceFields::arrays(Particles& p, const PairVolumes& volumes) const {
  PairArrays a = particle_arrays(p, motion_.f);
  a.kernel = kernel_;
  a.V = volumes.current();
  a.p = total_pressure_ ? total_pressure_->data() : p.p.data();
  if (diffusion_) {
    a.rho = p.rho.data();
    a.c = p.c.data();
    a.diffusion = diffusion_->data();
    a.delta = delta_;
    a.potential = potential_->data();
  }
  for (int k = 0; k < 6; ++k) a.tau[k] = tau_ ? tau_->data(k) : nullptr;
  return a;
}

void ForceFields::declare_pairs(const Particles& p, const PairVolumes& volumes, Accesses& a) const {
  a.reads(p.x, Reach::others).reads(p.h, Reach::others).updates(motion_.f);
  a.reads(volumes.now(), Reach::others).reads(total_pressure_ ? *total_pressure_ : p.p, Reach::others);
  if (diffusion_)
    a.reads(p.rho, Reach::others).reads(p.c).reads(*potential_, Reach::others).writes(*diffusion_);
  if (tau_) a.reads(*tau_, Reach::others);
}

void ForceFields::declare_reduction(const Particles& p, Accesses& a) const {
  a.reads(p.x).reads(p.h).updates(motion_.f).reads(total_pressure_ ? *total_pressure_ : p.p);
  if (diffusion_) a.reads(p.rho).reads(p.c).reads(*potential_).updates(*diffusion_);
  if (tau_) a.reads(*tau_);
}

}  // namespace courant
