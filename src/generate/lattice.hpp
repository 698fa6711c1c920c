#pragma once
// Where the particles of a lattice stand.
#include <vector>

#include "generate/scene.hpp"

namespace courant {

/// A number from [-1, 1) that depends on its arguments alone and has the same bits on every machine. Numbers
/// of neighbouring arguments have nothing to do with each other.
Real scattered(Id stream, Id index);

/// The centres of a lattice's cells, x outermost, z innermost, without those where `where` is not > 0, and
/// shifted by the jitter (after `where` was asked). `stream` tells lattices apart, so that no two of them
/// have the same shifts. [L] Stops at the first fault of `where`.
std::vector<Vec> lattice_points(const SceneLattice& lattice, Id stream, const Variables& variables,
                                Diagnostics& diagnostics);

}  // namespace courant
