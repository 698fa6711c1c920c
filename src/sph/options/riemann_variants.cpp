#include "base/instruction_set.hpp"
#include "sph/options/riemann_loops.hpp"

namespace courant {

namespace baseline {
RiemannLoop riemann_momentum_loop(KernelChoice kernel, int dim, bool uniform_h);
RiemannLoop riemann_mass_loop(KernelChoice kernel, int dim, bool uniform_h);
}  // namespace baseline
namespace avx2 {
RiemannLoop riemann_momentum_loop(KernelChoice kernel, int dim, bool uniform_h);
RiemannLoop riemann_mass_loop(KernelChoice kernel, int dim, bool uniform_h);
}  // namespace avx2
namespace avx512 {
RiemannLoop riemann_momentum_loop(KernelChoice kernel, int dim, bool uniform_h);
RiemannLoop riemann_mass_loop(KernelChoice kernel, int dim, bool uniform_h);
}  // namespace avx512

RiemannLoop riemann_momentum_loop(KernelChoice kernel, int dim, bool uniform_h) {
  return COURANT_VARIANT(riemann_momentum_loop)(kernel, dim, uniform_h);
}
RiemannLoop riemann_mass_loop(KernelChoice kernel, int dim, bool uniform_h) {
  return COURANT_VARIANT(riemann_mass_loop)(kernel, dim, uniform_h);
}

}  // namespace courant
