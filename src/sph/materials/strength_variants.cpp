#include "base/instruction_set.hpp"
#include "sph/materials/strength_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(spin_loop)
COURANT_DECLARE_VARIANTS(artificial_stress_loop)

StrengthLoop spin_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(spin_loop)(kernel, dim);
}
StrengthLoop artificial_stress_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(artificial_stress_loop)(kernel, dim);
}

}  // namespace courant
