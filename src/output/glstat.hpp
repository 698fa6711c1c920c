#pragma once
// The numbers of glstat, for all files that contain them.
#include "output/sample.hpp"

namespace courant {

/// LS-DYNA has no potential energy: it counts the work of gravity as external work, see glstat_text.
struct GlstatNumbers {
  Real kinetic = 0, internal = 0, hourglass = 0, stonewall = 0, discrete = 0, sliding = 0;  ///< [ML2/T2]
  Real external_work = 0, eroded_internal = 0, eroded_hourglass = 0, total = 0;             ///< [ML2/T2]
  Real ratio = 1, ratio_without_eroded = 1;  ///< of the total energy [-]
  Real added_mass = 0;                       ///< [M]
};

/// first_potential: potential energy at the first state [ML2/T2].
GlstatNumbers glstat_numbers(const Sample& sample, Real first_potential);

}  // namespace courant
