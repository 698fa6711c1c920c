#pragma once
// Shells and beams of *MAT_NULL: they weigh, touch and are pressed, and have no stress.
#include <memory>

#include "state/world.hpp"

namespace courant {

/// Tells what the parts of such a group weigh and how they move; nothing is computed in a step.
std::shared_ptr<Pass> make_null_elements(const ElementGroup& group);

}  // namespace courant
