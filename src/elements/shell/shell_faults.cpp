#include "elements/shell/shell_faults.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/run_error.hpp"

namespace courant {

void stop_for_thickness(const ElementGroup& group, Id part, Index e, Real thickness, const Clock& clock) {
  const ReadsForMessage unchecked;
  throw RunError(
      fmt::format("shell {} of part {} has the thickness {:.4g} at time {:.6g}, cycle {}", group.id[e], part,
                  thickness, clock.t, clock.cycle),
      std::isnan(thickness) ? StopCause::not_finite : StopCause::element,
      "it has been drawn to nothing: let it fail (*MAT_ADD_EROSION, FAIL of its material), or keep "
      "its thickness (ISTUPD 0 of *CONTROL_SHELL)");
}

void stop_for_distortion(const ElementGroup& group, Id part, Index e, bool at_point, const Clock& clock) {
  const ReadsForMessage unchecked;
  throw RunError(
      fmt::format("shell {} of part {} is turned inwards at one of its {} at time {:.6g}, cycle {}",
                  group.id[e], part, at_point ? "points" : "corners", clock.t, clock.cycle),
      StopCause::element,
      fmt::format(
          "the mesh is folded or sheared too far: let such shells be deleted ({} 1 of *CONTROL_SHELL), "
          "take a finer mesh, and check what presses on it",
          at_point ? "NFAIL4" : "NFAIL1"));
}

}  // namespace courant
