#pragma once
#include "laws/strength/strength.hpp"

namespace courant {

/// The law at a block of points in the directions a, b of their layer. `cosine`, `sine`: of the angle from e1
/// of the element to a, by point [-]. `rate_zz`: out, as of update_in_plane_stress.
void update_along_axes(const StrengthLaw& law, const Real* cosine, const Real* sine, const PointBlock& points,
                       Real* rate_zz);

}  // namespace courant
