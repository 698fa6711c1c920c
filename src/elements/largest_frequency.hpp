#pragma once
#include <functional>
#include <vector>

#include "base/real.hpp"

namespace courant {

/// Components of vectors over nodes: a number for each node.
using NodalVector = std::array<std::vector<Real>, 3>;

/// The largest omega with K u = omega^2 M u, K symmetric, M of the masses of nodes `m` (0: the node has no
/// part in it), by power iteration from a fixed random start: from below, within some percent where there are
/// many modes of almost that frequency. `stiffness(u, Ku)` may rely on components of u being about `size`
/// [L]; axes of `held` nodes stay where they are. [1/T]
Real largest_frequency(const std::vector<Real>& m, const std::vector<std::array<bool, 3>>& held, Real size,
                       const std::function<void(const NodalVector& u, NodalVector& Ku)>& stiffness);

}  // namespace courant
