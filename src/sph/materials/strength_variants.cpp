#include "base/instruction_set.hpp"
#include "sph/materials/strength_loops.hpp"

namespace courant {

namespace baseline {
StrengthLoop spin_loop(KernelChoice kernel, int dim);
StrengthLoop artificial_stress_loop(KernelChoice kernel, int dim);
}  // namespace baseline
namespace avx2 {
StrengthLoop spin_loop(KernelChoice kernel, int dim);
StrengthLoop artificial_stress_loop(KernelChoice kernel, int dim);
}  // namespace avx2
namespace avx512 {
StrengthLoop spin_loop(KernelChoice kernel, int dim);
StrengthLoop artificial_stress_loop(KernelChoice kernel, int dim);
}  // namespace avx512

StrengthLoop spin_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(spin_loop)(kernel, dim);
}
StrengthLoop artificial_stress_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(artificial_stress_loop)(kernel, dim);
}

}  // namespace courant
