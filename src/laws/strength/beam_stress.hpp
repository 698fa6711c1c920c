#pragma once
#include "laws/strength/strength.hpp"

namespace courant {

/// Whether points of beams can have the law: isotropic, with shear and a pressure of its own, and waves no
/// faster than at rest, as steps of beams follow from E.
inline bool serves_in_beams(const StrengthLaw& law) {
  return law.in_sheets() && !law.axes() && !law.deviator_only() && !law.stiffens() && law.shear_modulus() > 0;
}

/// A step of an isotropic law in a beam, whose stress has components xx, xy and zx only: the rates yy = zz,
/// the same by symmetry, are found by trial steps so that stress yy and zz stay 0, and left in `rate_yy`, one
/// for each point [1/T]. Rates yy, zz and yz of the block are not looked at. Only of laws that give all of
/// the stress.
void update_in_beam(const StrengthLaw& law, const PointBlock& block, Real* rate_yy);

}  // namespace courant
