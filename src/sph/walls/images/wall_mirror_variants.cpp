#include "base/instruction_set.hpp"
#include "sph/walls/images/wall_mirror_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(mirror_rates_loop)
COURANT_DECLARE_VARIANTS(mirror_forces_loop)

WallMirrorLoop mirror_rates_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(mirror_rates_loop)(kernel, dim);
}
WallMirrorLoop mirror_forces_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(mirror_forces_loop)(kernel, dim);
}

}  // namespace courant
