#pragma once
// The world a step acts on. Physics folders meet only here.
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "parallel/parallel.hpp"
#include "state/entities.hpp"
#include "state/pass.hpp"

namespace courant {

/// Energies that accumulate over the run or hold at t^n. dimension of all: ML2/T2 (in 2D per unit depth)
struct EnergyLedger {
  Real kinetic = 0;    ///< of particles and bodies, with half-step velocities as LS-DYNA does
  Real internal = 0;   ///< of active particles: volume work (and heat where the EOS uses it)
  Real discrete = 0;   ///< share of springs and dampers in `internal`
  Real potential = 0;  ///< - sum m g.x of active particles and bodies
  Real contact = 0;    ///< stored in penalty springs
  Real hourglass = 0;  ///< of hourglass control of elements
  /// Share of `hourglass` that is the bending energy of elastic solids: their hourglass forces are those of
  /// assumed strains (IHQ 6 with QM 1).
  Real assumed_bending = 0;
  Real bulk_viscosity = 0;  ///< of bulk viscosity of elements
  Real dissipated = 0;      ///< by viscosity, contact damping, friction (accumulates)
  Real external_work = 0;   ///< work done on the active particles from outside: load curves, box boundary,
                            ///< inflow minus outflow (accumulates)
  Real throughput =
      0;  ///< energy that passed through so far: sum of |work| of all kinds and of inflow (accumulates)
  Real initial = 0;  ///< total at t = 0
  /// Net work of the forces at t^n since the half step of `kinetic`: the effect of the different times of the
  /// terms.
  Real half_step = 0;
  /// For linear motion leapfrog conserves, exactly at every stable step, the energy at t^n less sum f^2
  /// dt^2/(8 m): that of the last step, and that of the first one, from which the ledger starts.
  Real below = 0, below_at_start = 0;
  Real most_internal = 0;  ///< largest that the guard saw
  Real peak = 0;  ///< largest `present` that the guard saw, and at least round-off of the rest energy m c^2
  Real total() const {
    return kinetic + internal + potential + contact + hourglass + bulk_viscosity + dissipated;
  }
  Real residual() const { return total() - initial - external_work; }
  /// The part of the residual that half steps do not explain: 0 where `half_step`, alone or with `below`,
  /// explains it.
  Real unexplained() const;
  /// Energy of the scene, independent of the origin of heights: the largest energy it had, plus the
  /// throughput. The reference of a residual. Not 0 after the first check of the guard.
  Real scale() const { return peak + throughput; }
  /// Fraction of `scale` that was created (> 0) or lost; 0 where it is round-off of the terms.
  Real error() const;
};

/// Named counters that end up in summary.yaml: clamps, deactivations, leaks. Never silently wrong.
using Counters = std::map<std::string, std::int64_t>;

struct World {
  int dim = 3;           ///< 2 or 3 (IDIM)
  bool goes_on = false;  ///< from a restart file
  Particles particles;
  std::vector<Id> part_ids;  ///< number in the deck of each part index
  Nodes nodes;
  Segments segments;
  /// Entity sets that physics add beside those.
  std::vector<std::unique_ptr<FieldSet>> other_sets;
  std::vector<std::unique_ptr<ElementGroup>> groups;  ///< solids; their fields are among `other_sets`
  EnergyLedger energy;
  Counters counters;
  std::map<std::string, Real> maxima;  ///< largest values over the run, for summary.yaml: max_penetration
  /// Blocks of active particles, and of active and halo particles, of each thread; the neighbour search
  /// defines them. Blocks of other sets are divided evenly.
  Shares shares, moving_shares;

  Index elements() const;  ///< of all groups
  /// A new entity set, empty. Throws std::logic_error where there is one of that name.
  FieldSet& add_set(const std::string& name);
  /// All entity sets.
  std::vector<FieldSet*> sets();
  std::vector<const FieldSet*> sets() const;

  /// Number in the deck of a particle's part; 0 in a world without a deck.
  Id part_id(Index particle) const {
    const auto part = static_cast<std::size_t>(particles.part[particle]);
    return part < part_ids.size() ? part_ids[part] : 0;
  }

  PassList passes;  ///< those the deck asks for
};

/// Whether only bodies, springs and lumped masses move.
bool moves_all_by_bodies(const World& world);

/// Per-part and per-interface sums for the histories; filled on request by the owning pass.
struct InterfaceForce {
  Id id = 0;
  std::string title;
  Vec on_surfa = Vec::Zero();  ///< total contact force on the tracked side (the particles) [ML/T2]; SURFB
                               ///< gets the opposite
  Real energy_stored = 0;      ///< in the springs now [ML2/T2]
  Real energy_damping = 0;     ///< dissipated by VDC so far
  Real energy_friction = 0;    ///< dissipated by friction so far
};
struct RigidBodyReport {
  Id part = 0;
  Real mass = 0;
  Vec x = Vec::Zero(), v = Vec::Zero(), omega = Vec::Zero(), force = Vec::Zero(), moment = Vec::Zero();
  Real kinetic_energy = 0;
};

}  // namespace courant
