#pragma once
// The scenes that are measured, as simulations ready to step.
#include <map>
#include <memory>
#include <string>

#include "app/run/simulation.hpp"

namespace courant::benchmarks {

using Parameters = std::map<std::string, std::string>;

/// The simulation of a scene; `path` counts from the root of the project, `cards` are added to its deck.
/// Throws std::runtime_error where the scene or the deck has faults.
std::unique_ptr<Simulation> build_scene(const std::string& path, const Parameters& parameters,
                                        const std::string& cards = {});

void take_steps(Simulation& s, std::int64_t steps);
/// At most `most_steps`.
void run_until(Simulation& s, Real t, std::int64_t most_steps);

/// Moves particles and pressures of `from` into `to`, which has not begun: the same scene with another speed
/// of sound, both with p = rho0 c0^2 (rho/rho0 - 1). So a stiff liquid starts from a flow that a soft one
/// took far fewer steps to.
void start_from(Simulation& to, Simulation& from, Real c0_to, Real c0_from, Real rho0);

/// Works on with that many threads from the next step on, without a rebuild of the lists.
void use_threads(Simulation& s, int threads);

}  // namespace courant::benchmarks
