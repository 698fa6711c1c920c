#pragma once
#include <algorithm>
#include <cmath>

#include "base/real.hpp"

namespace courant {

/// The factor on the step of elements (with `tssfac`) if constraints raise their largest frequency by up to
/// `growth`: 1 while that is stable. Their viscosity, xi of the critical damping, counts: dt < 2/omega
/// (sqrt(1 + xi^2) - xi). [-]
inline Real step_share(Real tssfac, Real growth) {
  constexpr Real stable = 0.95;  // of the last stable step
  constexpr Real xi = 0.1;       // Q1 is 0.06
  const auto damped = [](Real times) { return std::sqrt(1 + times * times * xi * xi) - times * xi; };
  return std::min(Real(1), stable * damped(growth) / (tssfac * growth * damped(1)));
}

}  // namespace courant
