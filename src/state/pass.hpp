#pragma once
// The kinds of pass in a step.
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "state/field.hpp"

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

struct World;
struct EnergyLedger;

/// Every pass has a name for the list that `courant run` prints and for the timing table. One object may be
/// of several kinds.
struct Pass {
  virtual ~Pass() = default;
  virtual std::string name() const = 0;
};

/// A pass divided among threads by blocks of an entity set. Stages follow from the declarations of passes: in
/// a stage every block goes through all passes in order, and threads wait only where a pass reads of others a
/// value that an earlier pass changed. `block` changes only values of entities [begin, end), or of the task
/// of its blocks where World::shares holds whole tasks. A thread processes its blocks in ascending order.
struct BlockPass : virtual Pass {
  virtual Phase phase() const = 0;
  /// The set whose blocks it processes; by default active particles (from Phase::drive on: moving ones).
  virtual const FieldSet& over(const World& world) const;
  /// Declares what it reads and changes. Called once, when the list of passes is complete.
  virtual void declare(const World& world, Accesses& accesses) const = 0;
  /// Before any block of the stage, on one thread.
  virtual void start(World& /*world*/, const Clock& /*clock*/) {}
  /// `begin` is a multiple of block_size.
  virtual void block(World& world, const Clock& clock, Index begin, Index end) = 0;
  /// After all blocks of all passes of the stage, on one thread. Sums of blocks are added here, in the order
  /// of blocks, so they have the same bits on any number of threads.
  virtual void finish(World& /*world*/, const Clock& /*clock*/) {}
};

/// A block pass of a phase.
template <Phase when>
struct PassOf : BlockPass {
  Phase phase() const final { return when; }
};
using Rate = PassOf<Phase::rates>;
/// Advances density, energy or stress over dt_old with the rates.
using Material = PassOf<Phase::laws>;
using Reduction = PassOf<Phase::reductions>;
/// Adds to forces. A pass that adds to nodes.f or segments.contact_force (in `finish`) first removes in
/// `start` its contribution of the last step.
using Force = PassOf<Phase::forces>;
/// Changes forces (or accelerations) after all are known: SPC, rigid bodies.
using Constraint = PassOf<Phase::constraints>;
using Drive = PassOf<Phase::drive>;
using Motion = PassOf<Phase::motion>;
using Relocation = PassOf<Phase::relocation>;
using Preparation = PassOf<Phase::preparation>;

/// Updates copies of entities (ghosts behind planes) between stages.
struct Exchanger : virtual Pass {
  /// `fields`: those that changed and will be read of neighbours.
  virtual void exchange(World& world, std::span<const FieldBase* const> fields) = 0;
  /// Updates all exchanged fields, after a rebuild of the lists.
  virtual void exchange_all(World& world) = 0;
};

/// Changes forces once dt is chosen, before outputs and the energy balance: the positions at t + dt, and so
/// the forces of walls, are known only then. Called on one thread; its loops run on all.
struct Impact : virtual Pass {
  virtual void strike(World& world, const Clock& clock) = 0;
};

struct TimeLimit : virtual Pass {
  struct Limit {
    Real dt;          ///< [T], infinity where there is none
    std::string who;  ///< its source: "sph particle 17 of part 1"
  };
  virtual Limit limit(const World& world, const Clock& clock) = 0;
  /// Whether an oscillating step would pump energy into it: elements, springs, contact of nodes. Not fluids,
  /// rotating bodies and joints, whose limits are far below those of instability and change in every step.
  virtual bool rings() const { return true; }
};
/// Updates data that depend on the order or the neighbourhood of particles. Called after particles were
/// sorted and their lists built: particle i was at old_of_new[i] before.
struct Refresh : virtual Pass {
  virtual void refreshed(World& world, const Clock& clock, std::span<const Index> old_of_new) = 0;
};
/// Adds to the energy ledger once the forces at t^n and dt are known, before the kick. Work over the step is
/// f . (v^{n-1/2} + v^{n+1/2})/2 dt_mean, which makes the change of kinetic energy exact.
struct EnergyTerm : virtual Pass {
  virtual void record(World& world, const Clock& clock, EnergyLedger& ledger) = 0;
  /// Adds the energies at t^n (not those that accumulate) to kinetic, internal, potential, contact,
  /// hourglass, bulk_viscosity, which are zero before. Called on request only.
  virtual void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const = 0;
};

/// The passes of a world. The order of adding matters only where accesses do not define one: among passes of
/// one phase that add to the same field, and for the ledger, the limits and the refresh after a rebuild.
class PassList {
 public:
  /// Returns the pass. Throws std::logic_error where it is in the list already.
  template <class P>
  std::shared_ptr<P> add(std::shared_ptr<P> pass) {
    if (contains(*pass)) throw std::logic_error("pass '" + pass->name() + "' is added twice");
    passes_.push_back(pass);
    return pass;
  }
  bool contains(const Pass& pass) const {
    for (const auto& known : passes_)
      if (known.get() == &pass) return true;
    return false;
  }
  /// All that are also a `Role`, in the order of adding.
  template <class Role>
  std::vector<Role*> all() const {
    std::vector<Role*> out;
    for (const auto& pass : passes_)
      if (auto* role = dynamic_cast<Role*>(pass.get())) out.push_back(role);
    return out;
  }
  /// The block passes of a phase, in the order required by their accesses. Throws std::logic_error where
  /// accesses contradict each other.
  std::vector<BlockPass*> in_phase(Phase phase, const World& world) const;
  std::size_t size() const { return passes_.size(); }

 private:
  std::vector<std::shared_ptr<Pass>> passes_;
};

}  // namespace courant
