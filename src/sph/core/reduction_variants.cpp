#include "base/instruction_set.hpp"
#include "sph/core/reduction_loops.hpp"

namespace courant {

namespace baseline {
ReductionLoop rates_reduction_loop(const RatesChoice& choice);
ReductionLoop forces_reduction_loop(const ForcesChoice& choice);
}  // namespace baseline
namespace avx2 {
ReductionLoop rates_reduction_loop(const RatesChoice& choice);
ReductionLoop forces_reduction_loop(const ForcesChoice& choice);
}  // namespace avx2
namespace avx512 {
ReductionLoop rates_reduction_loop(const RatesChoice& choice);
ReductionLoop forces_reduction_loop(const ForcesChoice& choice);
}  // namespace avx512

ReductionLoop rates_reduction_loop(const RatesChoice& choice) {
  return COURANT_VARIANT(rates_reduction_loop)(choice);
}
ReductionLoop forces_reduction_loop(const ForcesChoice& choice) {
  return COURANT_VARIANT(forces_reduction_loop)(choice);
}

}  // namespace courant
