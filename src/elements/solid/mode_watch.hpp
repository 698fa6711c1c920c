#pragma once
#include <array>
#include <memory>
#include <vector>

#include "elements/shape_watch.hpp"
#include "elements/solid/solids.hpp"

namespace courant {

/// Of the displacements u_i by the positions x_a, x_b in the material, turned back with the element: columns
/// xx yy zz xy yz zx. [1/L]
using SecondGradient = Eigen::Matrix<Real, 3, 6>;
/// Of the modes of bending and twisting of a brick. `start` and `now`: its corners in LS-DYNA's order;
/// homogeneous deformation and rigid motion have none.
SecondGradient second_gradient(const std::array<Vec, 8>& start, const std::array<Vec, 8>& now);
/// What that would cost in the material, by the assumed strains of IHQ 6 with QM 1
/// (docs/theory_structures.md, Hourglass control). [ML2/T2]
Real bending_energy(const std::array<Vec, 8>& start, const SecondGradient& gradient,
                    const SolidControl& material);

/// Examines solids of one point: the energy that their bending modes would cost in the material, less what
/// hourglass control stores. Modes are means over the nodes first, so that hourglass patterns, which
/// alternate from element to element, cancel, and bending remains. `maxima` of the world get
/// `unresisted_modes`, the largest over the parts of what is missing over the energy of the part (internal,
/// and of hourglass control with a stiffness), both summed over all looks [-], and `unresisted_modes_part`,
/// its number. A beam of n elements over its depth misses 1/(n^2 - 1), by which it bends too far. Elements
/// that yielded miss nothing; fluids, laws with directions and laws that are neither elastic nor plastic
/// (viscoelastic ones, foams) are not examined. Null: there are no such solids.
std::shared_ptr<ShapeWatch> make_mode_watch(const std::vector<SolidPart>& parts, World& world);

}  // namespace courant
