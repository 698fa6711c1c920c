#pragma once
#include <limits>
#include <memory>

#include "laws/strength/strength.hpp"

namespace courant {

/// J2 plasticity with linear hardening, as *MAT_PLASTIC_KINEMATIC has it.
struct LinearHardening {
  Real lambda = 0, G = 0;             ///< Lame's constants [M/LT2]
  Real yield = 0;                     ///< at the start [M/LT2]
  Real isotropic = 0, kinematic = 0;  ///< shares of the plastic modulus Ep: BETA Ep, (1 - BETA) Ep [M/LT2]
  Real fails_at = std::numeric_limits<Real>::infinity();       ///< plastic strain
  Real fails_at_time = std::numeric_limits<Real>::infinity();  ///< [T]
  Real C = 0, P = 0;  ///< of Cowper and Symonds [1/T], [-]; C = 0: no influence of the rate
};

/// `density` [M/L3]
std::shared_ptr<StrengthLaw> linear_hardening_law(Real density, const LinearHardening& data);

}  // namespace courant
