#pragma once
#include <vector>

#include "base/real.hpp"

namespace courant {

/// Distance to the nearest other point for each of `n` points; infinity for a lone one, 0 for points in one
/// place. x, y, z: shape n [L], finite. For set-up; fast where the points fill their cloud evenly.
std::vector<Real> nearest_distance(const Real* x, const Real* y, const Real* z, Index n);

}  // namespace courant
