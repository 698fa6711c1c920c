#include "base/instruction_set.hpp"
#include "search/near_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(near_loops)

NearLoops near_loops() {
  return COURANT_VARIANT(near_loops)();
}

}  // namespace courant
