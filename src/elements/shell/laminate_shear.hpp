#pragma once
#include "elements/shell/shells.hpp"

namespace courant {

/// Stiffness of a laminate across its plane over that of layers that shear alike, along the first direction
/// of the part and across it. [-]
struct LaminateShear {
  Real along = 1, across = 1, both = 1;  ///< both: of the sums of the two
};

/// Shear stress that is in equilibrium with bending stress, linear over the thickness in layers of modulus E:
/// K = (sum E I)^2 / integral S^2/G dz with S' = E (z - z_n); 5/6 for one layer. LAMSHT of *CONTROL_SHELL;
/// Whitney, Shear correction factors for orthotropic laminates under static load, J. Appl. Mech. 40 (1973).
LaminateShear laminate_shear(const ShellPart& part);

}  // namespace courant
