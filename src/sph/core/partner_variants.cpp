#include "base/instruction_set.hpp"
#include "sph/core/partner_loops.hpp"

namespace courant {

namespace baseline {
PartnerLoop partner_rates_loop(const RatesChoice& choice);
PartnerLoop partner_forces_loop(const ForcesChoice& choice);
}  // namespace baseline
namespace avx2 {
PartnerLoop partner_rates_loop(const RatesChoice& choice);
PartnerLoop partner_forces_loop(const ForcesChoice& choice);
}  // namespace avx2
namespace avx512 {
PartnerLoop partner_rates_loop(const RatesChoice& choice);
PartnerLoop partner_forces_loop(const ForcesChoice& choice);
}  // namespace avx512

PartnerLoop partner_rates_loop(const RatesChoice& choice) {
  return COURANT_VARIANT(partner_rates_loop)(choice);
}
PartnerLoop partner_forces_loop(const ForcesChoice& choice) {
  return COURANT_VARIANT(partner_forces_loop)(choice);
}

}  // namespace courant
