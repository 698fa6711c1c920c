#pragma once
#include <functional>
#include <optional>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// What contact and mass need of a shell's material.
struct ShellMaterial {
  Real ro = 0;  ///< density [M/L3]
  Real E = 0;   ///< Young's modulus [M/LT2]
  Real pr = 0;  ///< Poisson ratio [-]
};

/// Fills world.nodes (the nodes that shells use, in the order of the model; mass RO t A shared equally by an
/// element's corners) and world.segments (K = E/(3(1 - 2 PR)), thickness of *SECTION_SHELL). `material(part)`
/// gives the material of a part (index into Model::parts), nothing for a part whose material is not rigid:
/// such shells are refused, once per part.
void build_segments(const Deck& deck, const Model& model,
                    const std::function<std::optional<ShellMaterial>(Index part)>& material, World& world,
                    Diagnostics& diagnostics);

}  // namespace courant
