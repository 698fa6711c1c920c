#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/run_error.hpp"
#include "parallel/parallel.hpp"
#include "state/particle_loops.hpp"
#include "state/world.hpp"

namespace courant {

/// c^2 = (dp/dmu + B p / (1 + mu)^2) / rho0, from dE = -p dv with v = 1/(1 + mu).
template <class Law>
Real sound_speed2_of(const Law& law, Real rho0, Real mu, Real E, Real p) {
  return (law.dA(mu) + law.dB(mu) * E + law.B(mu) * p / ((1 + mu) * (1 + mu))) / rho0;
}

/// Largest mu for which a law holds.
template <class Law>
Real mu_limit_of(const Law& law) {
  if constexpr (requires { law.mu_limit(); })
    return law.mu_limit();
  else
    return std::numeric_limits<Real>::infinity();
}

/// The parts one EOS pass works for, and what their material adds to the law.
struct EosPart {
  std::vector<char> mine;      ///< per part of the model
  bool all_parts = false;      ///< every particle is mine: no test per particle
  std::vector<Real> rho0, pc;  ///< per part: reference density [M/L3], tensile cut-off (<= 0) [M/LT2]
};

/// `rho_limit`: up to which the law of the particle holds.
[[noreturn]] void stop_for_density(const World& world, const Clock& clock, Index particle, Real rho_limit);

/// Advances rho and E over dt_old and evaluates p and c of active particles. With energy, p is solved
/// implicitly: E* = E - 1/2 dv p + heat, p = (A + B E*)/(1 + 1/2 B dv), E = E* - 1/2 dv p  (dv: change of
/// relative volume).
template <class Law>
class EosPass : public Material {
 public:
  EosPass(Law law, EosPart part, World& world)
      : law_(law),
        part_(std::move(part)),
        reference_volume_(world.particles.fields.add<Real>({.name = "reference_volume", .dimension = "L3"})) {
    same_for_all_ = part_.all_parts;
    for (std::size_t k = 1; k < part_.rho0.size(); ++k)
      same_for_all_ = same_for_all_ && part_.rho0[k] == part_.rho0[0] && part_.pc[k] == part_.pc[0];
  }
  std::string name() const override { return std::string("eos ") + Law::name; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.drhodt).reads(p.part).reads(p.m).updates(p.rho).updates(p.p).updates(p.E).updates(p.c);
    a.reads(reference_volume_).reads(p.x).reads(p.id);
    for (const char* heat : {"dissipation", "viscous_dissipation"})
      if (const FieldBase* field = p.fields.find(heat)) a.reads_before(*field);
  }

  void start(World& world, const Clock&) override {
    const FieldSet& fields = world.particles.fields;
    heat_ = dynamic_cast<const Field<Real>*>(fields.find("dissipation"));
    viscous_ = dynamic_cast<const Field<Real>*>(fields.find("viscous_dissipation"));
    found_.resize(block_count(world.particles.active));
  }

  void block(World& world, const Clock& clock, Index begin, Index end) override {
    Found& found = found_[begin / block_size] = {};
    if (same_for_all_) return advance(world.particles, clock.dt_old, begin, end, 0, found);
    const Index* part = world.particles.part.data();
    for (Index i = begin, next = i; i < end; i = next) {  // particles of one part in a row
      while (next < end && part[next] == part[i]) ++next;
      if (part_.mine[part[i]]) advance(world.particles, clock.dt_old, i, next, part[i], found);
    }
  }

  void finish(World& world, const Clock& clock) override {
    std::int64_t without_speed = 0;
    for (const Found& found : found_) without_speed += found.without_speed;
    if (without_speed > 0) world.counters["sound_speed_clamped"] += without_speed;
    for (std::size_t b = 0; b < found_.size(); ++b) {
      if (found_[b].lowest > 0) continue;
      for (Index i = static_cast<Index>(b) * block_size; i < world.particles.active; ++i)
        if (part_.mine[world.particles.part[i]] && !holds(world.particles, i))
          stop_for_density(world, clock, i, rho_limit(world.particles.part[i]));
    }
  }

 private:
  /// In a block of particles.
  struct Found {
    Real lowest = 1;          ///< rho/rho0; 0 where the law does not hold
    Index without_speed = 0;  ///< particles with c^2 < 0, whose c was set to 0
  };

  Real rho_limit(Index part) const { return part_.rho0[part] * (1 + mu_limit_of(law_)); }
  /// Also false where the density is not a number.
  bool holds(const Particles& p, Index i) const { return p.rho[i] > 0 && p.rho[i] < rho_limit(p.part[i]); }

  void advance(Particles& p, Real dt, Index begin, Index end, Index part, Found& found) {
    if (law_.uses_energy())
      advance_with_energy(p, dt, begin, end, part, found);
    else
      advance_without(p, dt, begin, end, part, found);
  }

  void advance_with_energy(Particles& p, Real dt, Index begin, Index end, Index part, Found& found) {
    const Real rho0 = part_.rho0[part], pc = part_.pc[part], limit = rho_limit(part);
    for (Index i = begin; i < end; ++i) {
      const Real v_old = rho0 / p.rho[i];
      p.rho[i] += p.drhodt[i] * dt;
      const Real v = rho0 / p.rho[i], dv = v - v_old, mu = p.rho[i] / rho0 - 1;
      Real E = p.E[i] - 0.5 * dv * p.p[i];
      if (reference_volume_[i] > 0)
        E += ((heat_ ? (*heat_)[i] : 0) + (viscous_ ? (*viscous_)[i] : 0)) * dt / reference_volume_[i];
      const Real B = law_.B(mu);
      const Real pressure = std::max((law_.A(mu) + B * E) / (1 + 0.5 * B * dv), pc);
      E -= 0.5 * dv * pressure;
      p.p[i] = pressure;
      p.E[i] = E;
      const Real c2 = sound_speed2_of(law_, rho0, mu, E, pressure);
      p.c[i] = std::sqrt(std::max(c2, Real(0)));
      found.without_speed += c2 < 0;
      if (!(p.rho[i] >= found.lowest * rho0))
        found.lowest = p.rho[i] / rho0;  // also where it is not a number
      if (!(p.rho[i] < limit)) found.lowest = 0;
    }
  }

  /// The same with B = 0, in a form that vectorises: E only counts the work of the pressure.
  void advance_without(Particles& p, Real dt, Index begin, Index end, Index part, Found& found) {
    const Real rho0 = part_.rho0[part];
    const Law law = law_;
    std::array<Real, block_size> mu, half_dv, A, dA;
    loops_.compress(p.drhodt.data(), dt, rho0, p.rho.data(), mu.data(), half_dv.data(), begin, end);
    Index without_speed = 0;
#pragma omp simd reduction(+ : without_speed)
    for (Index k = 0; k < end - begin; ++k) {
      A[k] = law.A(mu[k]), dA[k] = law.dA(mu[k]);
      without_speed += dA[k] < 0;
    }
    found.without_speed += without_speed;
    loops_.load({A.data(), dA.data(), half_dv.data(), rho0, part_.pc[part]}, p.p.data(), p.E.data(),
                p.c.data(), begin, end);
    const ParticleLoops::Range range = loops_.range(p.rho.data(), begin, end);
    if (range.broken || !(range.most < rho_limit(part)))
      found.lowest = 0;
    else
      found.lowest = std::min(found.lowest, range.least / rho0);
  }

  Law law_;
  ParticleLoops loops_ = particle_loops();
  EosPart part_;
  Field<Real>& reference_volume_;
  const Field<Real>* heat_ = nullptr;     ///< null where no pass makes such heat
  const Field<Real>* viscous_ = nullptr;  ///< the same
  std::vector<Found> found_;
  bool same_for_all_ = false;  ///< every particle is mine, with one rho0 and one pc
};

}  // namespace courant
