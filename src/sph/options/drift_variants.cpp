#include "base/instruction_set.hpp"
#include "sph/options/drift_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(shifting_loop)
COURANT_DECLARE_VARIANTS(drift_rate_loop)
COURANT_DECLARE_VARIANTS(xsph_loop)

DriftLoop shifting_loop(KernelChoice kernel, int dim, bool correct) {
  return COURANT_VARIANT(shifting_loop)(kernel, dim, correct);
}
DriftLoop drift_rate_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(drift_rate_loop)(kernel, dim);
}
DriftLoop xsph_loop(KernelChoice kernel, int dim, bool uniform_h, bool normed) {
  return COURANT_VARIANT(xsph_loop)(kernel, dim, uniform_h, normed);
}

}  // namespace courant
