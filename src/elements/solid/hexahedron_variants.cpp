#include "base/instruction_set.hpp"
#include "elements/solid/hexahedron_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(hexahedron_loops)

HexahedronLoops hexahedron_loops() {
  return COURANT_VARIANT(hexahedron_loops)();
}

}  // namespace courant
