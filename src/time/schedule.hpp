#pragma once
// How stages follow from what passes declare.
#include <string>
#include <vector>

#include "state/world.hpp"

namespace courant {

/// Passes that threads work through with no serial work in between. `start` of all comes before, `finish` of
/// all after it.
struct StagePlan {
  struct Entry {
    BlockPass* pass;
    const FieldSet* over;
    Accesses accesses;
    bool waits = false;  ///< threads wait for each other before it
    std::string why{};   ///< it waits, or begins a stage: the resource and who changes it
  };
  std::vector<Entry> entries;
  std::vector<const Resource*> exchange;  ///< whose ghosts are brought up to date before the stage
};

/// The stages of a step: those up to the choice of dt, and those that move.
struct Schedule {
  std::vector<StagePlan> forces, motion;
};

/// A pass waits where it reads of others what an earlier pass of the stage changed, or changes what an
/// earlier one reads of others. It begins a new stage where that change comes in a `finish`, where its
/// `start` needs it, or where ghosts have to be exchanged in between. Throws std::logic_error where a pass
/// changes a field of another set than its own otherwise than in `start` or `finish`.
Schedule make_schedule(const World& world);

/// The stages as text, a line for each pass, for `courant run` and the docs.
std::string text_of(const Schedule& schedule);

}  // namespace courant
