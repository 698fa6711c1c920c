#include "base/instruction_set.hpp"
#include "sph/options/frozen_loops.hpp"

namespace courant {

namespace baseline {
FrozenLoop frozen_rates_loop(const FrozenChoice&);
FrozenLoop frozen_forces_loop(const FrozenChoice&);
}  // namespace baseline
namespace avx2 {
FrozenLoop frozen_rates_loop(const FrozenChoice&);
FrozenLoop frozen_forces_loop(const FrozenChoice&);
}  // namespace avx2
namespace avx512 {
FrozenLoop frozen_rates_loop(const FrozenChoice&);
FrozenLoop frozen_forces_loop(const FrozenChoice&);
}  // namespace avx512

FrozenLoop frozen_rates_loop(const FrozenChoice& choice) {
  return COURANT_VARIANT(frozen_rates_loop)(choice);
}
FrozenLoop frozen_forces_loop(const FrozenChoice& choice) {
  return COURANT_VARIANT(frozen_forces_loop)(choice);
}

}  // namespace courant
