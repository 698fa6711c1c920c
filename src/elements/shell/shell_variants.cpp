#include "base/instruction_set.hpp"
#include "elements/shell/shell_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(quadrilateral_loops)
COURANT_DECLARE_VARIANTS(triangle_loops)

ShellLoops quadrilateral_loops() {
  return COURANT_VARIANT(quadrilateral_loops)();
}
ShellLoops triangle_loops() {
  return COURANT_VARIANT(triangle_loops)();
}

}  // namespace courant
