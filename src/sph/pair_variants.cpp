#include "base/instruction_set.hpp"
#include "sph/kept_loops.hpp"
#include "sph/pair_loops.hpp"

namespace courant {

// One file *_loops.cpp for each kernel has them.
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

PairLoops loops_of(KernelChoice choice) {
  return with_kernel(choice, [](auto kernel) { return COURANT_VARIANT(loops_of<decltype(kernel)>)(); });
}

}  // namespace

PairLoop rates_loop(const RatesChoice& choice) {
  return loops_of(choice.kernel).rates(choice);
}
PairLoop forces_loop(const ForcesChoice& choice) {
  return loops_of(choice.kernel).forces(choice);
}
KeptLoop fix_loop(KernelChoice kernel, int dim) {
  return loops_of(kernel).fix(dim);
}

}  // namespace courant
