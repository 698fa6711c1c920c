#include "base/instruction_set.hpp"
#include "sph/riemann_loops.hpp"

namespace courant {

namespace baseline {
RiemannLoop riemann_momentum_loop(int dim);
RiemannLoop riemann_mass_loop(int dim);
}  // namespace baseline
namespace avx2 {
RiemannLoop riemann_momentum_loop(int dim);
RiemannLoop riemann_mass_loop(int dim);
}  // namespace avx2
namespace avx512 {
RiemannLoop riemann_momentum_loop(int dim);
RiemannLoop riemann_mass_loop(int dim);
}  // namespace avx512

RiemannLoop riemann_momentum_loop(int dim) {
  return COURANT_VARIANT(riemann_momentum_loop)(dim);
}
RiemannLoop riemann_mass_loop(int dim) {
  return COURANT_VARIANT(riemann_mass_loop)(dim);
}

}  // namespace courant
