#include "base/instruction_set.hpp"
#include "contact/nodes/face_bound_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(face_bound_loops)

FaceBoundLoops face_bound_loops() {
  return COURANT_VARIANT(face_bound_loops)();
}

}  // namespace courant
