#include "base/instruction_set.hpp"
#include "search/near_loops.hpp"

namespace courant {

namespace baseline {
NearLoops near_loops();
}
namespace avx2 {
NearLoops near_loops();
}
namespace avx512 {
NearLoops near_loops();
}

NearLoops near_loops() {
  return COURANT_VARIANT(near_loops)();
}

}  // namespace courant
