#pragma once
// Pressure of solids from an equation of state. Between the loops over hexahedra: the law of strength gets
// the deviator, and the pressure comes with the energy that all stresses and the bulk viscosity have added.
#include <memory>

#include "elements/solid/solid_loops.hpp"
#include "laws/eos/eos.hpp"
#include "laws/strength/strength.hpp"
#include "state/entities.hpp"

namespace courant {

/// With E the internal energy per reference volume (all of it: work of p, q and the deviator), p = A(mu) +
/// B(mu) E, and dv_old and dv the changes of V/V0 over half a step at the rates sum b_I.v_I with the b_I =
/// dV/dx_I of its start and of its end, through which the forces there move the corners:
///   E* = E - (p_old + q_old) dv_old - q dv + (s_old + s):D V_m dt/(2 V0),
///   p = (A + B E*)/(1 + B dv) or the cut-off, E_new = E* - p dv.
/// So the gas gives what the nodes get, however much it expands in a step (Caramana et al. 1998 call this
/// compatible).
/// q comes before p, with the sound speed of the old energy at the new volume.
class SolidPressure {
 public:
  /// Of a block, between the calls.
  struct Scratch {
    alignas(64) Real A[block_size], dA[block_size], B[block_size], dB[block_size];
    Real energy[block_size];          ///< per reference volume: E, then E* but for the work of s [M/LT2]
    Real half_dv[block_size];         ///< dv [-]
    Real pressure[block_size];        ///< with that energy [M/LT2]
    Real least_pressure[block_size];  ///< the cut-off [M/LT2]
    Real counted[block_size];         ///< of several points: work that is in `energy` [ML2/T2]
  };
  /// How a block turned out.
  struct Faults {
    Index beyond = -1;        ///< an element of the group at which the law has ended; -1: none
    Index without_speed = 0;  ///< elements with c^2 < 0, whose share of the sound speed was taken as 0
  };

  SolidPressure(std::shared_ptr<const EosLaw> eos, std::shared_ptr<const StrengthLaw> law)
      : eos_(std::move(eos)), law_(std::move(law)) {}

  const EosLaw& eos() const { return *eos_; }
  /// At the start. [M/LT2], [L/T]
  Real initial_pressure() const;
  Real initial_sound_speed() const;
  /// rho c^2 of compression alone, at the start. [M/LT2]
  Real bulk_modulus() const;

  /// Behind `strain`, before the law: leaves the deviator in the stress, energy and pressure in `own`, and
  /// the sound speed that q is to be made of in `scratch`. `energy`: internal, of the elements [ML2/T2];
  /// `memory`: memory of the law for them, null if it has none.
  void split(const ElementBlock& block, const SolidState& state, const Real* energy, Real* memory,
             SolidScratch& scratch, Scratch& own) const;
  /// Behind q, before the law.
  void predict(const ElementBlock& block, const SolidState& state, const SolidScratch& scratch,
               Scratch& own) const;
  /// Behind the law: pressure back into the stress, and the sound speed, which the law left its share in.
  Faults complete(const ElementBlock& block, const SolidState& state, SolidScratch& scratch,
                  Scratch& own) const;

  // The same of elements with several points and one pressure, whose deviators differ:
  /// What begins a step. `pressure`: of the block; energy and memory of all elements; tr D, of the block.
  struct Means {
    const Real *pressure, *energy;
    Real* memory;
    const Real* trace;
  };
  /// Before the points: energy and pressure with the work of p and q so far, which is in `scratch`, too.
  void begin(const ElementBlock& block, const SolidControl& control, const SolidState& state,
             const Means& means, SolidScratch& scratch, Scratch& own) const;
  /// Behind them, with their work in `scratch`: the pressure, its work, and instead of the law's share
  /// the sound speed, both of the block.
  Faults complete(const ElementBlock& block, const SolidState& state, Real* pressure, Real* sound_speed,
                  SolidScratch& scratch, Scratch& own) const;

 private:
  /// Of the present compression: A, B, energy, and the sound speed that q is made of.
  void evaluate(const ElementBlock& block, const SolidState& state, const Real* energy, Real* memory,
                SolidScratch& scratch, Scratch& own) const;
  /// Of element i of a block: its pressure, with the energy E before its own work; makes of the law's share
  /// the sound speed.
  Real finish(Index i, Real E, Real mu, const Scratch& own, Real& sound_speed, Faults& found) const;
  std::shared_ptr<const EosLaw> eos_;
  std::shared_ptr<const StrengthLaw> law_;
  OnePointLoops loops_ = hexahedron_loops();
};

/// Of small strains from the state at the start: a law that is in for `pressure` and its deviator.
std::shared_ptr<StrengthLaw> linear_response(const SolidPressure& pressure, const StrengthLaw& law);

}  // namespace courant
