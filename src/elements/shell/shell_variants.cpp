#include "base/instruction_set.hpp"
#include "elements/shell/shell_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(quadrilateral_loops)
COURANT_DECLARE_VARIANTS(triangle_loops)
COURANT_DECLARE_VARIANTS(full_quadrilateral_loops)
COURANT_DECLARE_VARIANTS(warped_quadrilateral_loops)

ShellLoops quadrilateral_loops() {
  return COURANT_VARIANT(quadrilateral_loops)();
}
ShellLoops triangle_loops() {
  return COURANT_VARIANT(triangle_loops)();
}
ShellLoops full_quadrilateral_loops() {
  return COURANT_VARIANT(full_quadrilateral_loops)();
}
ShellLoops warped_quadrilateral_loops() {
  return COURANT_VARIANT(warped_quadrilateral_loops)();
}
ShellLoops shell_loops(int corners, int places, const ShellControl& control) {
  if (corners == 3) return triangle_loops();
  if (places == 4) return full_quadrilateral_loops();
  return control.warps ? warped_quadrilateral_loops() : quadrilateral_loops();
}

}  // namespace courant
