#pragma once
// Whether the results of a run can be trusted.
#include <string>
#include <vector>

#include "keyword/deck.hpp"
#include "output/summary.hpp"

namespace courant {

/// Something that speaks against a run.
struct Finding {
  bool breaks = false;  ///< the results cannot be trusted; otherwise they are doubtful
  std::string text;     ///< what was found, and what to do about it
};

/// Energy from nowhere or lost, leaks, hourglassing, speeds and densities that the material is not made for,
/// clamped states: measured against `s.limits`. An error comes first.
std::vector<Finding> findings(const Summary& s);

/// "sound", "doubtful" or "broken".
std::string verdict_of(const std::vector<Finding>& found);

/// Writes verdict and reasons into the summary.
void judge(Summary& s);

/// Those of *COURANT_VERDICT; the usual ones where the deck has none.
VerdictLimits verdict_limits(const Deck& deck);

/// "energy error in percent of what it is measured against, in words": for the end of messag.
std::string energy_line(const EnergyLedger& e);

}  // namespace courant
