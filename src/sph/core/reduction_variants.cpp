#include "base/instruction_set.hpp"
#include "sph/core/reduction_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(rates_reduction_loop)
COURANT_DECLARE_VARIANTS(forces_reduction_loop)

ReductionLoop rates_reduction_loop(const RatesChoice& choice) {
  return COURANT_VARIANT(rates_reduction_loop)(choice);
}
ReductionLoop forces_reduction_loop(const ForcesChoice& choice) {
  return COURANT_VARIANT(forces_reduction_loop)(choice);
}

}  // namespace courant
