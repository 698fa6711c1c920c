#include "base/instruction_set.hpp"
#include "sph/walls/wall_edge_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(edge_rates_loop)
COURANT_DECLARE_VARIANTS(edge_forces_loop)

WallMirrorLoop edge_rates_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(edge_rates_loop)(kernel, dim);
}
WallMirrorLoop edge_forces_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(edge_forces_loop)(kernel, dim);
}

}  // namespace courant
