#pragma once
// Restart: what survives a step outside of fields, and how all of a world is saved and loaded.
#include <string>
#include <utility>
#include <vector>

#include "state/saved_state.hpp"
#include "state/world.hpp"

namespace courant {

/// A pass, or another object of a run, whose members survive a step. Members that a pass sets before it reads
/// them are left out, as is what the deck says.
struct Restartable {
  virtual ~Restartable() = default;
  /// Hands every member that later steps depend on to the archive, which saves or loads it. Between two
  /// steps.
  virtual void keep(Archive& archive) = 0;
  /// After loading, with particles where they were when neighbours were searched last: makes anew what
  /// depends on that alone.
  virtual void relist(World& /*world*/) {}
  /// After that, with particles where they are now: makes anew what depends on the loaded fields.
  virtual void loaded(World& /*world*/) {}
};

/// The passes of a world that keep something, each once, by name.
std::vector<std::pair<std::string, Restartable*>> restartables_of(const World& world);

/// Fields that a restart needs, particle groups, ledger, counters and maxima. Loading throws RestartError
/// where the state is that of another world.
void keep_world(World& world, Archive& archive);
void keep_clock(Clock& clock, Archive& archive);

}  // namespace courant
