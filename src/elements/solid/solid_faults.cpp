#include "elements/solid/solid_faults.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/run_error.hpp"

namespace courant {

void stop_for_compression(const ElementGroup& group, Id part, Real mu_limit, Index e, const Clock& clock) {
  throw RunError(
      fmt::format(
          "solid {} of part {} is compressed beyond the end of its equation of state, {:.4g} times its "
          "reference density, where the pressure becomes infinite, at time {:.6g}, cycle {}",
          group.id[e], part, 1 + mu_limit, clock.t, clock.cycle),
      StopCause::density);
}

void stop_for_volume(const ElementGroup& group, Id part, const StableStep& found, const Clock& clock) {
  const ReadsForMessage unchecked;
  throw RunError(
      fmt::format("solid {} of part {} has {} at time {:.6g}, cycle {}", group.id[found.smallest], part,
                  std::isnan(found.least_volume)
                      ? std::string("a volume that is no number")
                      : fmt::format("turned inside out (volume {:.4g} of its first)", found.least_volume),
                  clock.t, clock.cycle),
      std::isnan(found.least_volume) ? StopCause::not_finite : StopCause::element,
      std::isnan(found.least_volume)
          ? ""
          : "the mesh there is crushed or sheared too far: let elements be deleted before (ERODE of "
            "*CONTROL_TIMESTEP, *MAT_ADD_EROSION), make hourglass control stiffer (IHQ 5 or 6), take a finer "
            "mesh or ELFORM 2, and check what presses on it");
}

}  // namespace courant
