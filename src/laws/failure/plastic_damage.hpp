#pragma once
// Isotropic damage D of a plastic material (Lemaitre 1985): the stress is 1 - D of that of the material
// without damage, which strains alike.
#include <array>
#include <functional>
#include <memory>

#include "laws/strength/strength.hpp"

namespace courant {

/// A step in which a point has flown.
struct DamageStep {
  Real before, after;          ///< effective plastic strain [-]
  Real damage;                 ///< before the step [-]
  std::array<Real, 6> stress;  ///< after it, without damage: xx yy zz xy yz zx [M/LT2]
};

struct PlasticDamage {
  /// Damage after the step, at least that before it. [-]
  std::function<Real(const DamageStep&)> after;
  Real critical = 1;  ///< damage at which a point fails [-]
};

/// `of` with damage; its first history number must be the plastic strain. Beside damage a point fails where
/// `of` says so.
std::shared_ptr<StrengthLaw> damage_by_flow(std::shared_ptr<StrengthLaw> of, PlasticDamage damage);

}  // namespace courant
