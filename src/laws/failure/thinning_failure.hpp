#pragma once
#include <limits>
#include <memory>

#include "laws/strength/strength.hpp"

namespace courant {

/// Logarithmic strains of sheets at which a point fails.
struct ThinningLimits {
  Real thinning = std::numeric_limits<Real>::infinity();  ///< of the thickness, taken away from it [-]
  Real major = std::numeric_limits<Real>::infinity();     ///< the larger principal strain in the plane [-]
  bool any() const { return thinning < never_fails || major < never_fails; }
};

/// `of` with these limits beside its own; it must have a plastic strain.
std::shared_ptr<StrengthLaw> fail_by_thinning(std::shared_ptr<StrengthLaw> of, const ThinningLimits& limits);

}  // namespace courant
