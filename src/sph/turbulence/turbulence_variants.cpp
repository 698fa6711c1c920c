#include "base/instruction_set.hpp"
#include "sph/turbulence/turbulence_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(turbulence_loop)

TurbulenceLoop turbulence_loop(KernelChoice kernel, int dim, bool uniform_h, bool k_epsilon) {
  return COURANT_VARIANT(turbulence_loop)(kernel, dim, uniform_h, k_epsilon);
}

}  // namespace courant
