#include "base/instruction_set.hpp"
#include "sph/options/pair_viscosity_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(pair_viscosity_loop)

PairViscosityLoop pair_viscosity_loop(KernelChoice kernel, int dim, bool uniform_h) {
  return COURANT_VARIANT(pair_viscosity_loop)(kernel, dim, uniform_h);
}

}  // namespace courant
