#pragma once
#include <string>
#include <vector>

#include "output/summary.hpp"

namespace courant {

/// What the end of a run says of the whole: timing table, sums, ranges, warnings, banner. One line each.
std::vector<std::string> end_report(const Summary& summary);

/// Leaked particles, an energy ledger that does not close, speeds and densities out of range: one line each,
/// with advice.
std::vector<std::string> end_warnings(const Summary& summary);

/// Residual of the energy ledger in percent of what passed through; 0 where nothing did.
Real residual_percent(const EnergyLedger& energy);

/// "51 s", "3 min 07 s", "2 h 05 min"
std::string duration(double seconds);

}  // namespace courant
