#include "base/instruction_set.hpp"
#include "elements/shell/shell_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(quadrilateral_loops)
COURANT_DECLARE_VARIANTS(triangle_loops)
COURANT_DECLARE_VARIANTS(full_quadrilateral_loops)

ShellLoops quadrilateral_loops() {
  return COURANT_VARIANT(quadrilateral_loops)();
}
ShellLoops triangle_loops() {
  return COURANT_VARIANT(triangle_loops)();
}
ShellLoops full_quadrilateral_loops() {
  return COURANT_VARIANT(full_quadrilateral_loops)();
}

}  // namespace courant
