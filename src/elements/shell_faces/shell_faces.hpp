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

/// Adds the masses of shells (RO t A, shared equally by an element's corners) to world.nodes, and fills
/// world.segments (K = E/(3(1 - 2 PR)), thickness of *SECTION_SHELL or *ELEMENT_SHELL_THICKNESS), in the
/// order of Model::shells. `material(part, layup)` gives the material of a part (index into Model::parts), or
/// of its shells with layers of their own (index into Model::layups by `layups_of_groups`, else -1), nothing
/// where it is neither rigid nor one that shells can deform with: such shells are refused, once per part.
/// `node_of`: the node of the world of each node of the model.
void build_segments(const Deck& deck, const Model& model,
                    const std::function<std::optional<ShellMaterial>(Index part, Index layup)>& material,
                    const std::vector<Index>& node_of, World& world, Diagnostics& diagnostics);

}  // namespace courant
