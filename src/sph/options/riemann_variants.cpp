#include "base/instruction_set.hpp"
#include "sph/options/riemann_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(riemann_momentum_loop)
COURANT_DECLARE_VARIANTS(riemann_mass_loop)

RiemannLoop riemann_momentum_loop(KernelChoice kernel, int dim, bool uniform_h) {
  return COURANT_VARIANT(riemann_momentum_loop)(kernel, dim, uniform_h);
}
RiemannLoop riemann_mass_loop(KernelChoice kernel, int dim, bool uniform_h) {
  return COURANT_VARIANT(riemann_mass_loop)(kernel, dim, uniform_h);
}

}  // namespace courant
