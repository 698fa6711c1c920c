#include "base/instruction_set.hpp"
#include "sph/options/drift_loops.hpp"

namespace courant {

namespace baseline {
DriftLoop shifting_loop(KernelChoice kernel, int dim, bool correct);
DriftLoop drift_rate_loop(KernelChoice kernel, int dim);
DriftLoop xsph_loop(KernelChoice kernel, int dim, bool uniform_h);
}  // namespace baseline
namespace avx2 {
DriftLoop shifting_loop(KernelChoice kernel, int dim, bool correct);
DriftLoop drift_rate_loop(KernelChoice kernel, int dim);
DriftLoop xsph_loop(KernelChoice kernel, int dim, bool uniform_h);
}  // namespace avx2
namespace avx512 {
DriftLoop shifting_loop(KernelChoice kernel, int dim, bool correct);
DriftLoop drift_rate_loop(KernelChoice kernel, int dim);
DriftLoop xsph_loop(KernelChoice kernel, int dim, bool uniform_h);
}  // namespace avx512

DriftLoop shifting_loop(KernelChoice kernel, int dim, bool correct) {
  return COURANT_VARIANT(shifting_loop)(kernel, dim, correct);
}
DriftLoop drift_rate_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(drift_rate_loop)(kernel, dim);
}
DriftLoop xsph_loop(KernelChoice kernel, int dim, bool uniform_h) {
  return COURANT_VARIANT(xsph_loop)(kernel, dim, uniform_h);
}

}  // namespace courant
