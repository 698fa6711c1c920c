#pragma once
#include <array>

#include "base/real.hpp"

namespace courant {

/// Friction of a rigid wall that differs by direction: along a, the projection of d on the wall, and along
/// b = n x a.
struct OrthoFriction {
  std::array<Real, 2> at_rest{};  ///< SFRICA, SFRICB [-]
  std::array<Real, 2> sliding{};  ///< DFRICA, DFRICB [-]
  std::array<Real, 2> decay{};    ///< DECAYA, DECAYB [T/L]
  Vec d = Vec::UnitX();

  /// Coefficients at a speed: DFRIC + (SFRIC - DFRIC) exp(-DECAY speed).
  std::array<Real, 2> coefficients(Real speed) const;
  /// Force on a point of mass m that would slide with `slip` at the end of a step dt; `normal`: size of the
  /// force along n. -normal (mu_a v_a, mu_b v_b)/|v|, v the velocity along the wall at the end of the step,
  /// which the force has brought about (implicit); where |v| would be 0, what stops it: so it holds loads
  /// with (T_a/mu_a)^2 + (T_b/mu_b)^2 <= normal^2. `confined`: it can slide along the line of `slip` alone,
  /// as in 2D, and what the friction pushes across is lost. Throws RunError where d is along n. [ML/T2]
  Vec force(const Vec& n, const Vec& slip, Real normal, Real m, Real dt, bool confined) const;
};

}  // namespace courant
