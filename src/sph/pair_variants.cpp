#include "base/instruction_set.hpp"
#include "sph/pair_loops.hpp"

namespace courant {

namespace baseline {
PairLoop rates_loop(const RatesChoice&);
PairLoop forces_loop(const ForcesChoice&);
}  // namespace baseline
namespace avx2 {
PairLoop rates_loop(const RatesChoice&);
PairLoop forces_loop(const ForcesChoice&);
}  // namespace avx2
namespace avx512 {
PairLoop rates_loop(const RatesChoice&);
PairLoop forces_loop(const ForcesChoice&);
}  // namespace avx512

PairLoop rates_loop(const RatesChoice& choice) {
  return COURANT_VARIANT(rates_loop)(choice);
}
PairLoop forces_loop(const ForcesChoice& choice) {
  return COURANT_VARIANT(forces_loop)(choice);
}

}  // namespace courant
