#pragma once
#include <vector>

#include "base/real.hpp"

namespace courant {

/// Distance to the nearest other point for each of `n` points; infinity for a lone one, 0 for points in one
/// place. x, y, z: shape n [L], finite. For set-up. The time grows as n, also where a few points stand far
/// off.
std::vector<Real> nearest_distance(const Real* x, const Real* y, const Real* z, Index n);

}  // namespace courant
