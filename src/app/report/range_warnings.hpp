#pragma once
#include <string>
#include <vector>

#include "state/ranges.hpp"

namespace courant {

/// Where speeds and densities of a run leave what a weakly compressible liquid represents: speeds above
/// `most_mach` of the sound speed, densities off RO by more than a share of `most_change`. One line each.
/// Nothing of gases, nor where an equation of state is made for shocks.
std::vector<std::string> range_warnings(const Ranges& ranges, Real most_mach, Real most_change);

/// The lines of messag: largest speed and extreme densities of each part with particles.
std::vector<std::string> range_lines(const Ranges& ranges);

}  // namespace courant
