#pragma once
#include "laws/strength/strength.hpp"

namespace courant {

/// A step of an isotropic law in a beam, whose stress has components xx, xy and zx only: the rates yy = zz,
/// the same by symmetry, are found by trial steps so that stress yy and zz stay 0. Rates yy, zz and yz of the
/// block are not looked at. Only of laws that give all of the stress.
void update_in_beam(const StrengthLaw& law, const PointBlock& block);

}  // namespace courant
