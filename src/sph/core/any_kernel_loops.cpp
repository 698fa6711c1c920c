// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/core/pair_sums.hpp"

namespace courant::COURANT_SIMD {

template PairLoops loops_of<AnyKernel>();

}  // namespace courant::COURANT_SIMD
