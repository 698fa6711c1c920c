#include "base/instruction_set.hpp"
#include "elements/solid/full_hexahedron_loops.hpp"
#include "elements/solid/hexahedron_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(hexahedron_loops)
COURANT_DECLARE_VARIANTS(full_hexahedron_loops)

HexahedronLoops hexahedron_loops() {
  return COURANT_VARIANT(hexahedron_loops)();
}
FullHexahedronLoops full_hexahedron_loops() {
  return COURANT_VARIANT(full_hexahedron_loops)();
}

}  // namespace courant
