#pragma once
// What a deck says about single particles at the start: their velocities and pressures.
#include <span>
#include <string>

#include "generate/scene.hpp"

namespace courant {

struct PlacedNode {
  Id id;
  Vec x;  ///< [L]
};

/// Appends *INITIAL_VELOCITY_NODE and *INITIAL_STRESS_SPH for the nodes of a part where its velocity or
/// pressure is an expression of place: cards in long format, so that 13 digits fit. Stops at the first fault
/// of an expression.
void append_initial_state(const ScenePart& part, std::span<const PlacedNode> nodes,
                          const Variables& variables, std::string& out, Diagnostics& diagnostics);

}  // namespace courant
