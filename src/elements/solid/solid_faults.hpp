#pragma once
// Solids with which a run cannot continue, and deleted ones.
#include "elements/erosion.hpp"
#include "elements/solid/solid_loops.hpp"
#include "state/entities.hpp"
#include "state/pass.hpp"

namespace courant {

/// Element e of part `part` is beyond mu_limit, where its equation of state has ended.
[[noreturn]] void stop_for_compression(const ElementGroup& group, Id part, Real mu_limit, Index e,
                                       const Clock& clock);
/// An element is turned inside out, or has a volume that is no number.
[[noreturn]] void stop_for_volume(const ElementGroup& group, Id part, const StableStep& found,
                                  const Clock& clock);

/// Deleted elements of a block become a cube at rest without stress.
void hold_deleted(const Erosion& erosion, Index begin, Index count, SolidScratch& scratch);

}  // namespace courant
