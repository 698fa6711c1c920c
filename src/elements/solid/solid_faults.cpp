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
      std::isnan(found.least_volume) ? ""
      : clock.cycle == 0
          ? "its corners are at fault: check their order and their positions"
          : "the mesh there is crushed or sheared too far: let elements be deleted before (ERODE of "
            "*CONTROL_TIMESTEP, *MAT_ADD_EROSION), make hourglass control stiffer (IHQ 5 or 6), take a finer "
            "mesh, and check what presses on it");
}

void hold_deleted(const Erosion& erosion, Index begin, Index count, SolidScratch& scratch) {
  for (Index i = 0; i < count; ++i) {
    if (!erosion.dead(begin + i)) continue;
    erosion.clear(begin + i);
    for (auto& rate : scratch.rate) rate[i] = 0;
    for (auto& speed : scratch.speed) speed[i] = 0;
    for (auto& turn : scratch.half_turn) turn[i] = 0;
    for (std::size_t k = 0; k < SolidScratch::rows; ++k)
      scratch.position[k][i] = k == 0 || k == 4 || k == 8 ? 1 : 0;
    for (auto& opened : scratch.opened) opened[i] = 0;
    scratch.compression[i] = scratch.work[i] = 0, scratch.middle_volume[i] = 1;
  }
}

}  // namespace courant
