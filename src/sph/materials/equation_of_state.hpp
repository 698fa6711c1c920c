#pragma once
// Density, energy and pressure of particles whose part has an equation of state.
#include <cstdint>
#include <memory>
#include <vector>

#include "laws/eos/eos.hpp"
#include "state/particle_loops.hpp"
#include "state/world.hpp"

namespace courant {

/// The parts one pass works for, and what their material adds to the law.
struct EosParts {
  std::vector<char> mine;              ///< per part of the model
  bool all_parts = false;              ///< every particle is mine: no test per particle
  std::vector<Real> rho0, pc;          ///< per part: reference density [M/L3], tensile cut-off (<= 0) [M/LT2]
  const Field<Real>* burnt = nullptr;  ///< share of each particle whose products have a pressure; null: all
  const Field<Real>* least_pressure = nullptr;  ///< of each particle, instead of pc where the law uses energy
};

/// The density of a particle is none that its law holds for. `rho_limit`: up to which the law holds [M/L3]
[[noreturn]] void stop_for_density(const World& world, const Clock& clock, Index particle, Real rho_limit);

/// Advances rho and E over dt_old and evaluates p and c of active particles. With energy, p is solved
/// implicitly: E* = E - 1/2 dv p + heat, p = (A + B E*)/(1 + 1/2 B dv), E = E* - 1/2 dv p  (dv: change of
/// relative volume).
class EquationOfState : public Material {
 public:
  /// `heat`: powers that go into E of a law that uses it [ML2/T3].
  EquationOfState(std::shared_ptr<const EosLaw> law, EosParts parts, std::vector<const Field<Real>*> heat,
                  World& world);
  std::string name() const override { return "eos " + law_->name(); }
  void declare(const World& world, Accesses& a) const override;
  void start(World& world, const Clock&) override { found_.resize(block_count(world.particles.active)); }
  void block(World& world, const Clock& clock, Index begin, Index end) override;
  void finish(World& world, const Clock& clock) override;

 private:
  /// In a block of particles.
  struct EosFaults {
    Real lowest = 1;          ///< rho/rho0; 0 where the law does not hold
    Index without_speed = 0;  ///< particles with c^2 < 0, whose c was set to 0
  };

  Real rho_limit(Index part) const { return parts_.rho0[part] * (1 + mu_limit_); }
  /// Also false where the density is not a number.
  bool holds(const Particles& p, Index i) const { return p.rho[i] > 0 && p.rho[i] < rho_limit(p.part[i]); }
  void advance(Particles& p, Real dt, Index begin, Index end, Index part, EosFaults& found) const;
  void advance_with_energy(Particles& p, Real dt, Index begin, Index end, Index part, EosFaults& found) const;
  /// The same with B = 0, in a form that vectorises: E only counts the work of the pressure.
  void advance_without(Particles& p, Real dt, Index begin, Index end, Index part, EosFaults& found) const;

  Real* memory(Index begin) const { return memory_ ? memory_->data() + begin : nullptr; }

  std::shared_ptr<const EosLaw> law_;
  ParticleLoops loops_ = particle_loops();
  EosParts parts_;
  std::vector<const Field<Real>*> heat_;
  Field<Real>& reference_volume_;
  Field<Real>* memory_ = nullptr;  ///< null: the law has none
  Real mu_limit_;
  std::vector<EosFaults> found_;
  bool same_for_all_ = false;  ///< every particle is mine, with one rho0 and one pc
};

}  // namespace courant
