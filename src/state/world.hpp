#pragma once
// The world a step acts on, and the kinds of pass it is made of. Physics folders meet only here.
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "parallel/parallel.hpp"
#include "state/entities.hpp"

namespace courant {

/// Time of the run. `dt` is the step about to be taken from t to t + dt, `dt_old` the one that led to t (0 at
/// the start).
struct Clock {
  Real t = 0;
  Real dt = 0;
  Real dt_old = 0;
  std::int64_t cycle = 0;
  Real dt_mean() const { return 0.5 * (dt_old + dt); }  ///< interval from v^{n-1/2} to v^{n+1/2}
};

/// Energies that accumulate over the run or hold at t^n. dimension of all: ML2/T2 (in 2D per unit depth)
struct EnergyLedger {
  Real kinetic = 0;        ///< of particles and bodies, with half-step velocities as LS-DYNA does
  Real internal = 0;       ///< of active particles: volume work (and heat where the EOS uses it)
  Real potential = 0;      ///< - sum m g.x of active particles and bodies
  Real contact = 0;        ///< stored in penalty springs
  Real dissipated = 0;     ///< by viscosity, contact damping, friction (accumulates)
  Real external_work = 0;  ///< work done on the active particles from outside: load curves, box boundary,
                           ///< inflow minus outflow (accumulates)
  Real throughput =
      0;  ///< energy that passed through so far: sum of |work| of all kinds and of inflow (accumulates)
  Real initial = 0;  ///< total at t = 0
  Real total() const { return kinetic + internal + potential + contact + dissipated; }
  Real residual() const { return total() - initial - external_work; }
};

struct World;

/// Every kind of pass has a name for the list that `courant run` prints and for the timing table.
struct Pass {
  virtual ~Pass() = default;
  virtual std::string name() const = 0;
};

/// A pass whose work threads share by blocks of particles. A step is a few stages; in a stage every block
/// goes through the block passes of that stage in order, with no waiting in between but where a pass `waits`.
/// So `block` writes only what belongs to particles [begin, end), and reads of other particles only what was
/// finished before threads last waited for each other. A thread takes its blocks in ascending order; where
/// World::shares holds whole Strips, passes of active particles may write what belongs to their strip.
struct BlockPass : Pass {
  /// Whether it needs what the passes before it in the stage wrote for all particles: then threads wait for
  /// each other before it.
  virtual bool waits() const { return false; }
  /// Before any block of the stage, on one thread.
  virtual void start(World& /*world*/, const Clock& /*clock*/) {}
  /// `begin` is a multiple of block_size; `end` may be beyond world.particles.active where the stage has the
  /// rim, too (motions).
  virtual void block(World& world, const Clock& clock, Index begin, Index end) = 0;
  /// After all blocks of all passes of the stage, on one thread. What blocks summed up is added here, in the
  /// order of blocks, so that it has the same bits on any number of threads.
  virtual void finish(World& /*world*/, const Clock& /*clock*/) {}
};

// Stage "rates": everything from x and v of the last motion.
/// Rates from the velocities of the last kick: drho/dt, velocity gradient; forces that depend on them go to
/// f, which is zero before.
struct Rate : BlockPass {};
/// Advances rho and E over dt_old with the rates, then gives p, c (and stress).
struct Material : BlockPass {};
/// Sums or searches over particles once materials are known; changes nothing of theirs.
struct Tally : BlockPass {};

// Stage "forces": what needs the pressures of neighbours.
/// Adds to particles.f of active particles. Who adds to nodes.f or segments.contact_force (in `finish`) first
/// takes back in `start` what it added a step ago.
struct Force : BlockPass {};
/// Changes forces (or accelerations) after all are known: SPC, rigid bodies. Those of particles in `block`,
/// those of nodes in `finish`.
struct Constraint : BlockPass {};

// Stage "motion".
/// Moves what it owns: v += a dt_mean, x += v dt; or brings up to date what the next step's pair loops read.
/// Blocks cover active and rim particles.
struct Motion : BlockPass {};

/// Brings copies of particles (images behind planes) up to date, between the stages.
struct Exchanger : Pass {
  virtual void before_rates(World& world) = 0;   ///< what motion changed
  virtual void before_forces(World& world) = 0;  ///< what rates and materials changed
};

struct TimeLimit : Pass {
  struct Limit {
    Real dt;          ///< [T], infinity where there is none
    std::string who;  ///< what set it: "sph particle 17 of part 1"
  };
  virtual Limit limit(const World& world, const Clock& clock) = 0;
};
/// Keeps what depends on the order or the neighbourhood of particles. Called after particles were sorted and
/// their lists built: particle i was at old_of_new[i] before.
struct Refresh : Pass {
  virtual void refreshed(World& world, const Clock& clock, std::span<const Index> old_of_new) = 0;
};
/// Adds to the energy ledger once the forces at t^n and dt are known, before the kick. Work over the step is
/// f . (v^{n-1/2} + v^{n+1/2})/2 dt_mean, which makes the change of kinetic energy exact.
struct EnergyTerm : Pass {
  virtual void record(World& world, const Clock& clock, EnergyLedger& ledger) = 0;
  /// Adds what holds at t^n (not what accumulates) to kinetic, internal, potential, contact, which are zero
  /// before. Called only when somebody wants to know.
  virtual void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const = 0;
};

/// Named counters that end up in summary.yaml: clamps, deactivations, leaks. Never silently wrong.
using Counters = std::map<std::string, std::int64_t>;

struct World {
  int dim = 3;  ///< 2 or 3 (IDIM)
  Particles particles;
  std::vector<Id> part_ids;  ///< number in the deck of each part index
  Nodes nodes;
  Segments segments;
  EnergyLedger energy;
  Counters counters;
  std::map<std::string, Real> maxima;  ///< largest values over the run, for summary.yaml: max_penetration
  /// Which thread works on which blocks of active particles, and of active and rim particles; neighbours
  /// choose.
  Shares shares, moving_shares;

  /// Number in the deck of a particle's part; 0 in a world without a deck.
  Id part_id(Index particle) const {
    const auto part = static_cast<std::size_t>(particles.part[particle]);
    return part < part_ids.size() ? part_ids[part] : 0;
  }

  // The passes the deck asks for, in the order the step runs them. One object may stand in several lists.
  std::vector<std::shared_ptr<Exchanger>> exchangers;
  std::vector<std::shared_ptr<Rate>> rates;
  std::vector<std::shared_ptr<Material>> materials;
  std::vector<std::shared_ptr<Tally>> tallies;
  std::vector<std::shared_ptr<Force>> forces;
  std::vector<std::shared_ptr<Constraint>> constraints;
  std::vector<std::shared_ptr<Motion>> motions;
  std::vector<std::shared_ptr<TimeLimit>> time_limits;
  std::vector<std::shared_ptr<Refresh>> refreshes;
  std::vector<std::shared_ptr<EnergyTerm>> energy_terms;
};

/// Per-part and per-interface sums for the histories; filled on request by whoever owns them.
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
