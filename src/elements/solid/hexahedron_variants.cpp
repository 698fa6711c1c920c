#include "base/instruction_set.hpp"
#include "elements/solid/hexahedron_loops.hpp"

namespace courant {

namespace baseline {
HexahedronLoops hexahedron_loops();
}
namespace avx2 {
HexahedronLoops hexahedron_loops();
}
namespace avx512 {
HexahedronLoops hexahedron_loops();
}

HexahedronLoops hexahedron_loops() {
  return COURANT_VARIANT(hexahedron_loops)();
}

}  // namespace courant
