#include "base/instruction_set.hpp"
#include "sph/options/renormal_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(renormal_rates_loop)
COURANT_DECLARE_VARIANTS(renormal_forces_loop)

RenormalLoop renormal_rates_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(renormal_rates_loop)(kernel, dim);
}
RenormalLoop renormal_forces_loop(KernelChoice kernel, int dim, bool uniform_h, RenormalForce what) {
  return COURANT_VARIANT(renormal_forces_loop)(kernel, dim, uniform_h, what);
}

}  // namespace courant
