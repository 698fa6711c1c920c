#pragma once
// The kinds of pass a step is made of.
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

/// Every kind of pass has a name for the list that `courant run` prints and for the timing table. One object
/// may be several kinds at once.
struct Pass {
  virtual ~Pass() = default;
  virtual std::string name() const = 0;
};

/// A pass whose work threads share by blocks of an entity set. Stages are made from what passes declare: in a
/// stage every block goes through all passes in order, and threads wait for each other only where a pass
/// reads of others what an earlier one changed. `block` changes only what belongs to entities [begin, end),
/// or to the task of its blocks where World::shares holds whole tasks. A thread takes its blocks in
/// ascending order.
struct BlockPass : virtual Pass {
  virtual Phase phase() const = 0;
  /// The set whose blocks it works on; active particles (from Phase::drive on: moving ones) unless it says
  /// otherwise.
  virtual const FieldSet& over(const World& world) const;
  /// What it reads and changes. Called once, when the list of passes is complete.
  virtual void declare(const World& world, Accesses& accesses) const = 0;
  /// Before any block of the stage, on one thread.
  virtual void start(World& /*world*/, const Clock& /*clock*/) {}
  /// `begin` is a multiple of block_size.
  virtual void block(World& world, const Clock& clock, Index begin, Index end) = 0;
  /// After all blocks of all passes of the stage, on one thread. What blocks summed up is added here, in the
  /// order of blocks, so that it has the same bits on any number of threads.
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
/// Adds to forces. Who adds to nodes.f or segments.contact_force (in `finish`) first takes back in `start`
/// what it added a step ago.
using Force = PassOf<Phase::forces>;
/// Changes forces (or accelerations) after all are known: SPC, rigid bodies.
using Constraint = PassOf<Phase::constraints>;
using Drive = PassOf<Phase::drive>;
using Motion = PassOf<Phase::motion>;
using Relocation = PassOf<Phase::relocation>;
using Preparation = PassOf<Phase::preparation>;

/// Brings copies of entities elsewhere (ghosts behind planes) up to date, between stages.
struct Exchanger : virtual Pass {
  /// `fields`: those that changed and will be read of neighbours.
  virtual void exchange(World& world, std::span<const FieldBase* const> fields) = 0;
  /// All that are exchanged: after a rebuild of the lists.
  virtual void exchange_all(World& world) = 0;
};

/// Changes forces once dt is chosen, before outputs and the energy balance see them: where points would be at
/// t + dt, and so what a wall does to them, is known only then. On one thread; its loops are shared.
struct Impact : virtual Pass {
  virtual void strike(World& world, const Clock& clock) = 0;
};

struct TimeLimit : virtual Pass {
  struct Limit {
    Real dt;          ///< [T], infinity where there is none
    std::string who;  ///< what set it: "sph particle 17 of part 1"
  };
  virtual Limit limit(const World& world, const Clock& clock) = 0;
  /// Whether what it limits would be pumped by steps that go back and forth: elements, springs, contact of
  /// nodes. Not fluids, turning bodies and joints, whose limits lie far below what would make them unstable,
  /// and change all the time.
  virtual bool rings() const { return true; }
};
/// Keeps what depends on the order or the neighbourhood of particles. Called after particles were sorted and
/// their lists built: particle i was at old_of_new[i] before.
struct Refresh : virtual Pass {
  virtual void refreshed(World& world, const Clock& clock, std::span<const Index> old_of_new) = 0;
};
/// Adds to the energy ledger once the forces at t^n and dt are known, before the kick. Work over the step is
/// f . (v^{n-1/2} + v^{n+1/2})/2 dt_mean, which makes the change of kinetic energy exact.
struct EnergyTerm : virtual Pass {
  virtual void record(World& world, const Clock& clock, EnergyLedger& ledger) = 0;
  /// Adds what holds at t^n (not what accumulates) to kinetic, internal, potential, contact, hourglass,
  /// bulk_viscosity, which are zero before. Called only when somebody wants to know.
  virtual void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const = 0;
};

/// The passes of a world. The order of adding counts only where accesses leave it open: among passes of one
/// phase that add to the same field, and for the ledger, the limits and what follows a rebuild.
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
  /// The block passes of a phase, in the order that their accesses ask for. Throws std::logic_error where
  /// accesses contradict each other.
  std::vector<BlockPass*> in_phase(Phase phase, const World& world) const;
  std::size_t size() const { return passes_.size(); }

 private:
  std::vector<std::shared_ptr<Pass>> passes_;
};

}  // namespace courant
