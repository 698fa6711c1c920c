#include "base/instruction_set.hpp"
#include "sph/options/frozen_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(frozen_rates_loop)
COURANT_DECLARE_VARIANTS(frozen_forces_loop)

FrozenLoop frozen_rates_loop(const FrozenChoice& choice) {
  return COURANT_VARIANT(frozen_rates_loop)(choice);
}
FrozenLoop frozen_forces_loop(const FrozenChoice& choice) {
  return COURANT_VARIANT(frozen_forces_loop)(choice);
}

}  // namespace courant
