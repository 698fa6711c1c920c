#pragma once
// Stages from the declarations of passes.
#include <string>
#include <vector>

#include "state/world.hpp"

namespace courant {

/// Passes that threads execute without serial work in between. `start` of all comes before, `finish` of all
/// after it.
struct StagePlan {
  struct Entry {
    BlockPass* pass;
    const FieldSet* over;
    Accesses accesses;
    bool waits = false;  ///< threads wait for each other before it
    std::string why{};   ///< reason of the wait or the new stage: the resource and the pass that changes it
  };
  std::vector<Entry> entries;
  std::vector<const Resource*> exchange;  ///< fields whose ghosts are updated before the stage
};

/// The stages of a step: those up to the choice of dt, and those of motion.
struct Schedule {
  std::vector<StagePlan> forces, motion;
};

/// A pass waits where it reads of others a resource that an earlier pass of the stage changed, or changes one
/// that an earlier pass reads of others. It begins a new stage where that change is made in a `finish`, where
/// its `start` needs it, or where ghosts have to be exchanged in between. Throws std::logic_error where a
/// pass changes a field of another set than its own otherwise than in `start` or `finish`.
Schedule make_schedule(const World& world);

/// The stages as text, a line for each pass, for `courant run` and the docs.
std::string text_of(const Schedule& schedule);

}  // namespace courant
