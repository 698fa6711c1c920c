#include "base/instruction_set.hpp"
#include "sph/core/pair_loops.hpp"
#include "sph/options/frozen_loops.hpp"

namespace courant {

// any_kernel_loops.cpp has them for all instruction sets; the kernels that have a file *_loops.cpp of their
// own have them for those beyond the baseline.
namespace baseline {
template <class Kernel>
PairLoops loops_of();
}
namespace avx2 {
template <class Kernel>
PairLoops loops_of();
}
namespace avx512 {
template <class Kernel>
PairLoops loops_of();
}

namespace {

using LoopsOf = PairLoops (*)();

PairLoops loops_of(KernelChoice choice) {
  LoopsOf own = nullptr;
  if (choice == KernelChoice::cubic_spline)
    own =
        variant<LoopsOf>(nullptr, COURANT_AVX2(loops_of<CubicSpline>), COURANT_AVX512(loops_of<CubicSpline>));
  if (choice == KernelChoice::wendland_c2)
    own = variant<LoopsOf>(nullptr, COURANT_AVX2(loops_of<WendlandC2>), COURANT_AVX512(loops_of<WendlandC2>));
  return own != nullptr ? own() : COURANT_VARIANT(loops_of<AnyKernel>)();
}

}  // namespace

PairLoop rates_loop(const RatesChoice& choice) {
  return loops_of(choice.kernel).rates(choice);
}
PairLoop forces_loop(const ForcesChoice& choice) {
  return loops_of(choice.kernel).forces(choice);
}
FrozenLoop fix_loop(KernelChoice kernel, int dim) {
  return loops_of(kernel).fix(dim);
}

}  // namespace courant
