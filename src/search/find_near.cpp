#include "base/instruction_set.hpp"
#include "search/near_loops.hpp"

namespace courant {

namespace baseline {
void find_near(const NearQuery&, Index, Index, NearFound&);
}
namespace avx2 {
void find_near(const NearQuery&, Index, Index, NearFound&);
}
namespace avx512 {
void find_near(const NearQuery&, Index, Index, NearFound&);
}

FindNear find_near() {
  return COURANT_VARIANT(find_near);
}

}  // namespace courant
