#pragma once
#include <string>
#include <vector>

#include "state/ranges.hpp"

namespace courant {

/// Where speeds and densities of a run leave what a weakly compressible liquid stands for: speeds above a
/// fifth of the sound speed, densities off by more than a tenth. One line each. Nothing of gases.
std::vector<std::string> range_warnings(const Ranges& ranges);

/// The lines of messag: largest speed and extreme densities of each part with particles.
std::vector<std::string> range_lines(const Ranges& ranges);

}  // namespace courant
