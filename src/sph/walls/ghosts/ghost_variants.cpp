#include "base/instruction_set.hpp"
#include "sph/walls/ghosts/ghost_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(ghost_rate_loop)
COURANT_DECLARE_VARIANTS(squeezed_by_ghosts_loop)
COURANT_DECLARE_VARIANTS(ghost_pressure_loop)

GhostLoop ghost_rate_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(ghost_rate_loop)(kernel, dim);
}
GhostLoop squeezed_by_ghosts_loop(KernelChoice kernel, int dim) {
  return COURANT_VARIANT(squeezed_by_ghosts_loop)(kernel, dim);
}
GhostLoop ghost_pressure_loop(KernelChoice kernel, int dim, bool stress) {
  return COURANT_VARIANT(ghost_pressure_loop)(kernel, dim, stress);
}

}  // namespace courant
