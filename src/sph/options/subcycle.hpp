#pragma once
// *COURANT_SUBCYCLE
#include <string>

#include "search/neighbours.hpp"
#include "state/world.hpp"

namespace courant {

/// Whether forces between particles may be those of outer steps only (state/subcycle.hpp).
struct SubcycleChoice {
  int most = 1;           ///< steps of an outer interval; 1: each step has its forces
  std::string why_not{};  ///< what needs each step, where there are particles and a structure
};

/// Makes the passes between particles that the world has slow. Call it when all of them are added, before
/// those of loads and contact.
void add_subcycle(const SubcycleChoice&, Neighbours&, World&);

}  // namespace courant
