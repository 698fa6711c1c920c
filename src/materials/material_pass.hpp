#pragma once
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/run_error.hpp"
#include "parallel/parallel.hpp"
#include "state/world.hpp"

namespace courant {

/// c^2 = (dp/dmu + B p / (1 + mu)^2) / rho0, from dE = -p dv with v = 1/(1 + mu).
template <class Law>
Real sound_speed2_of(const Law& law, Real rho0, Real mu, Real E, Real p) {
  return (law.dA(mu) + law.dB(mu) * E + law.B(mu) * p / ((1 + mu) * (1 + mu))) / rho0;
}

/// The parts one EOS pass works for, and what their material adds to the law.
struct EosPart {
  std::vector<char> mine;      ///< per part of the model
  bool all_parts = false;      ///< every particle is mine: no test per particle
  std::vector<Real> rho0, pc;  ///< per part: reference density [M/L3], tensile cut-off (<= 0) [M/LT2]
};

[[noreturn]] void stop_for_density(const World& world, const Clock& clock, Index particle);

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
  }
  std::string name() const override { return std::string("eos ") + Law::name; }

  void update(World& world, const Clock& clock) override {
    Particles& p = world.particles;
    const auto* heat = dynamic_cast<const Field<Real>*>(p.fields.find("dissipation"));
    const auto* viscous = dynamic_cast<const Field<Real>*>(p.fields.find("viscous_dissipation"));
    const Real dt = clock.dt_old;
    const Real lowest = -maximum(p.active, [&](Index i) -> Real {
      const Index part = p.part[i];
      if (!part_.all_parts && !part_.mine[part]) return -1;
      const Real rho0 = part_.rho0[part];
      const Real v_old = rho0 / p.rho[i];
      p.rho[i] += p.drhodt[i] * dt;
      const Real v = rho0 / p.rho[i], dv = v - v_old, mu = p.rho[i] / rho0 - 1;
      Real E = p.E[i] - 0.5 * dv * p.p[i];
      if (law_.uses_energy() && reference_volume_[i] > 0)
        E += ((heat ? (*heat)[i] : 0) + (viscous ? (*viscous)[i] : 0)) * dt / reference_volume_[i];
      const Real B = law_.B(mu);
      const Real pressure = std::max((law_.A(mu) + B * E) / (1 + 0.5 * B * dv), part_.pc[part]);
      E -= 0.5 * dv * pressure;
      p.p[i] = pressure;
      p.E[i] = E;
      p.c[i] = std::sqrt(std::max(sound_speed2_of(law_, rho0, mu, E, pressure), Real(0)));
      return -p.rho[i] / rho0;
    });
    if (p.active > 0 && !(lowest > 0)) {
      for (Index i = 0; i < p.active; ++i)
        if (!(p.rho[i] > 0)) stop_for_density(world, clock, i);
    }
  }

 private:
  Law law_;
  EosPart part_;
  Field<Real>& reference_volume_;
};

}  // namespace courant
