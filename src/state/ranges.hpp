#pragma once
// How far the state of the particles went during a run.
#include <string>
#include <vector>

#include "base/real.hpp"

namespace courant {

/// A largest or smallest value, with its particle and time.
struct Extreme {
  Real value = 0;
  Id particle = 0;
  Real t = 0;  ///< [T]
};

/// Extremes of one part of particles.
struct PartRange {
  Id part = 0;
  Real rho0 = 1;  ///< reference density RO [M/L3]
  Real c0 = 0;    ///< sound speed at the start [L/T]
  /// Of a liquid that should hardly change its density: the field that makes it stiffer; else empty.
  std::string stiffness_field{};
  bool seen = false;     ///< it had an active particle
  Extreme speed;         ///< largest [L/T]
  Extreme density_low;   ///< lowest rho/rho0 [-]
  Extreme density_high;  ///< highest rho/rho0 [-]
};
using Ranges = std::vector<PartRange>;  ///< by part index of the model; `seen` is false without particles

}  // namespace courant
