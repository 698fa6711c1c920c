#include "base/instruction_set.hpp"
#include "sph/options/kept_loops.hpp"

namespace courant {

namespace baseline {
KeptLoop kept_rates_loop(const KeptChoice&);
KeptLoop kept_forces_loop(const KeptChoice&);
}  // namespace baseline
namespace avx2 {
KeptLoop kept_rates_loop(const KeptChoice&);
KeptLoop kept_forces_loop(const KeptChoice&);
}  // namespace avx2
namespace avx512 {
KeptLoop kept_rates_loop(const KeptChoice&);
KeptLoop kept_forces_loop(const KeptChoice&);
}  // namespace avx512

KeptLoop kept_rates_loop(const KeptChoice& choice) {
  return COURANT_VARIANT(kept_rates_loop)(choice);
}
KeptLoop kept_forces_loop(const KeptChoice& choice) {
  return COURANT_VARIANT(kept_forces_loop)(choice);
}

}  // namespace courant
