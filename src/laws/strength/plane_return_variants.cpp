#include "base/instruction_set.hpp"
#include "laws/strength/plane_return.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(plane_return_loops)

PlaneReturnLoops plane_return_loops() {
  return COURANT_VARIANT(plane_return_loops)();
}

}  // namespace courant
