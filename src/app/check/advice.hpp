#pragma once
// What to change in a deck whose run stopped: one line, from few facts.
#include <cstdint>
#include <string>

#include "app/run/simulation.hpp"
#include "base/run_error.hpp"

namespace courant {

/// What is known of a run that stopped. Speeds in [L/T], lengths in [L], times in [T].
struct StopFacts {
  StopCause cause = StopCause::other;
  std::string hint;  ///< of the error itself
  std::int64_t cycle = 0;
  std::string dt_set_by;  ///< source of the last step
  bool has_contact = false;
  Real tssfac = 0.9;
  Real contact_share = 0;                  ///< last step over what contact would allow, 0 without contact
  Real start_speed = 0;                    ///< largest of particles and walls at the start
  Real fall_speed = 0;                     ///< that gravity can give over the size of the scene at the start
  Real sound_speed = 0;                    ///< smallest of the parts at the start
  Real density_low = 1, density_high = 1;  ///< rho/RO over the run
  Real spacing = 0;                        ///< of particles
  std::int64_t initial_penetrations = 0;
  Real initial_depth = 0;   ///< deepest of these
  std::int64_t leaked = 0;  ///< particles that went through a wall
  /// Of the equation of state of a liquid; empty: none is nearly incompressible.
  std::string stiffness_field;
  bool tension = false;   ///< some liquid allows tension (PC < 0)
  bool strength = false;  ///< some particles have strength
  bool particles = true;  ///< there are any
};

/// Taken when the first step is known: what later states no longer tell.
StopFacts facts_at_start(Simulation& simulation);
/// The rest, when the run has stopped.
void add_facts_at_stop(StopFacts& facts, Simulation& simulation, const RunError& error,
                       const std::string& dt_set_by);

/// One line, without "hint: ", or nothing. The first cause that fits: what the deck asked for (TSSFAC,
/// positions, units), then the hint of the error, then the state of the flow.
std::string advice(const StopFacts& facts);

}  // namespace courant
