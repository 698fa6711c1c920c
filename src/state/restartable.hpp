#pragma once
// Restart: state outside of fields that survives a step, and saving and loading of a whole world.
#include <string>
#include <utility>
#include <vector>

#include "state/saved_state.hpp"
#include "state/world.hpp"

namespace courant {

/// A pass, or another object of a run, whose members survive a step. Members that a pass sets before it reads
/// them are omitted, as is the content of the deck.
struct Restartable {
  virtual ~Restartable() = default;
  /// Passes every member on which later steps depend to the archive, which saves or loads it. Called between
  /// two steps.
  virtual void keep(Archive& archive) = 0;
  /// Called after loading, with particles at the positions of the last neighbour search: recomputes the data
  /// that depend on these positions only.
  virtual void relist(World& /*world*/) {}
  /// Called after that, with particles at their present positions: recomputes the data that depend on the
  /// loaded fields.
  virtual void loaded(World& /*world*/) {}
};

/// The passes of a world with state, each once, by name.
std::vector<std::pair<std::string, Restartable*>> restartables_of(const World& world);

/// Fields that a restart needs, particle groups, ledger, counters and maxima. Loading throws RestartError if
/// the state is that of another world.
void keep_world(World& world, Archive& archive);
void keep_clock(Clock& clock, Archive& archive);

}  // namespace courant
