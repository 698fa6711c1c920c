#include "base/instruction_set.hpp"
#include "laws/strength/rate_factor.hpp"
#include "laws/strength/yield_return.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(return_loops)
COURANT_DECLARE_VARIANTS(rate_loops)

ReturnLoops return_loops() {
  return COURANT_VARIANT(return_loops)();
}

RateLoops rate_loops() {
  return COURANT_VARIANT(rate_loops)();
}

}  // namespace courant
