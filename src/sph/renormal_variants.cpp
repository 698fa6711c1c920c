#include "base/instruction_set.hpp"
#include "sph/renormal_loops.hpp"

namespace courant {

namespace baseline {
RenormalLoop renormal_rates_loop(int dim);
RenormalLoop renormal_forces_loop(int dim, bool reverse);
}  // namespace baseline
namespace avx2 {
RenormalLoop renormal_rates_loop(int dim);
RenormalLoop renormal_forces_loop(int dim, bool reverse);
}  // namespace avx2
namespace avx512 {
RenormalLoop renormal_rates_loop(int dim);
RenormalLoop renormal_forces_loop(int dim, bool reverse);
}  // namespace avx512

RenormalLoop renormal_rates_loop(int dim) {
  return COURANT_VARIANT(renormal_rates_loop)(dim);
}
RenormalLoop renormal_forces_loop(int dim, bool reverse) {
  return COURANT_VARIANT(renormal_forces_loop)(dim, reverse);
}

}  // namespace courant
