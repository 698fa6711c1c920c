#pragma once
#include "state/entities.hpp"
#include "state/pass.hpp"

namespace courant {

/// A shell without a thickness, or with one that is no number. [L]
[[noreturn]] void stop_for_thickness(const ElementGroup& group, Id part, Index e, Real thickness,
                                     const Clock& clock);

/// A shell that is turned inwards at a corner, or with 2 x 2 points at one of these.
[[noreturn]] void stop_for_distortion(const ElementGroup& group, Id part, Index e, bool at_point,
                                      const Clock& clock);

}  // namespace courant
