#pragma once
#include "state/entities.hpp"
#include "state/pass.hpp"

namespace courant {

/// A shell without a thickness, or with one that is no number. [L]
[[noreturn]] void stop_for_thickness(const ElementGroup& group, Id part, Index e, Real thickness,
                                     const Clock& clock);

}  // namespace courant
