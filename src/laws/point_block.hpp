#pragma once
// Points of one part that a law works on at once. Laws know no particles, elements or world: an SPH particle,
// the middle of a solid and a layer of a shell all come to them as entries of these plain arrays.
#include <array>
#include <cmath>
#include <span>

#include "base/real.hpp"

namespace courant {

struct PointBlock {
  Index count = 0;  ///< at most block_size
  Real dt = 0;      ///< [T]
  /// D of the middle of the step, in the axes at its end: xx yy zz xy yz zx, of the tensor. [1/T]
  std::array<const Real*, 6> rate{};
  /// Cauchy, in the same order; in: already turned to the present axes, out: at the end of the step. The
  /// deviator where the part has an equation of state. [M/LT2]
  std::array<Real*, 6> stress{};
  const Real* compression = nullptr;  ///< mu = rho/rho0 - 1 at the end of the step; null: taken as 0 [-]
  const Real* pressure = nullptr;     ///< of the equation of state, where there is one [M/LT2]
  const Real* energy = nullptr;       ///< internal energy per reference volume [M/LT2]
  /// Out, of a law that gives the deviator only, where somebody cuts the pressure off: below what. It holds
  /// StrengthLaw::pressure_cutoff() before. [M/LT2]
  Real* least_pressure = nullptr;
  /// Out. Of a law that gives the deviator only: its share sqrt(4G/(3 rho)), to which the square of the
  /// equation of state's is to be added. [L/T]
  Real* sound_speed = nullptr;
  /// One array for each component of each of StrengthLaw::history(), in order.
  std::span<Real* const> history{};
};

/// Of waves: that at rest, in a body that is denser by mu and as stiff as before.
inline void keep_stiffness(const PointBlock& block, Real c0) {
  Real* __restrict c = block.sound_speed;
  const Real* mu = block.compression;
  for (Index i = 0; i < block.count; ++i) c[i] = mu ? c0 / std::sqrt(1 + mu[i]) : c0;
}

}  // namespace courant
