#pragma once
// The relaxation in front of a run: another simulation of the deck, whose state the run begins with.
#include <functional>
#include <optional>
#include <string>

#include "app/run/run_ends.hpp"
#include "app/run/simulation.hpp"

namespace courant {

/// First line of the file `relax`.
inline constexpr const char* relaxation_head =
    "#         time       kinetic         ratio         ahead     best DRFCTR\n";

struct RelaxationEnd {
  bool converged = false, stopped = false;
  Real ratio = 0;       ///< largest kinetic energy since the look before, over the largest of all [-]
  Real ahead = 1;       ///< share of the path of the nodes that is still ahead, by how changes shrink [-]
  Real factor = 0;      ///< DRFCTR that suits the lowest frequency; 0: not known [-]
  bool creeps = false;  ///< at rest by its energy for long, but nodes moved on
  Real yielded = 0;     ///< largest plastic strain, where a load acts at once [-]
  Real time = 0;        ///< [T]
  std::int64_t steps = 0;
};

/// Runs a simulation of RunPhase::relaxation until it is at rest, DRTERM, or `stop` says so. `line` gets a
/// line for each look: time, kinetic energy, ratio, share of the way ahead, best DRFCTR. Throws RunError.
RelaxationEnd relax(Simulation& relaxing, const std::function<bool()>& stop,
                    const std::function<void(const std::string&)>& line);

/// The same in front of a run whose deck asks for it: writes the file `relax`, hands the state to `run`, and
/// reports it by `tell`. Returns what `stop` said, if that ended it. Throws RunError where `options` lack
/// the other simulation.
std::optional<RunEnd> relax_before(Simulation& run, const RunOptions& options,
                                   const std::function<std::optional<RunEnd>()>& stop,
                                   const std::function<void(const std::string&)>& tell);

}  // namespace courant
