#pragma once
#include <algorithm>
#include <cmath>

#include "base/real.hpp"

namespace courant {

/// What is left of the step of elements, of which `tssfac` is taken, where constraints make their largest
/// frequency up to `growth` times as large: all of it while that is stable. Their viscosity, of which that is
/// xi of the critical damping, takes part: dt < 2/omega (sqrt(1 + xi^2) - xi). [-]
inline Real step_share(Real tssfac, Real growth) {
  constexpr Real stable = 0.95;  // of the last stable step
  constexpr Real xi = 0.1;       // Q1 is 0.06
  const auto damped = [](Real times) { return std::sqrt(1 + times * times * xi * xi) - times * xi; };
  return std::min(Real(1), stable * damped(growth) / (tssfac * growth * damped(1)));
}

}  // namespace courant
