#include "base/instruction_set.hpp"
#include "search/near_loops.hpp"

namespace courant {

namespace baseline {
Index find_near(const NearQuery&, Index, Index, Index*);
}
namespace avx2 {
Index find_near(const NearQuery&, Index, Index, Index*);
}
namespace avx512 {
Index find_near(const NearQuery&, Index, Index, Index*);
}

FindNear find_near() {
  return COURANT_VARIANT(find_near);
}

}  // namespace courant
