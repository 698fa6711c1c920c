#pragma once
// Positions at which solids of materials with REF 1 are without stress.
#include <array>
#include <functional>
#include <vector>

#include "elements/solid/solids.hpp"

namespace courant {

struct ReferenceGeometry {
  std::array<std::vector<Real>, 3> x;  ///< of nodes of the world [L]
  std::vector<char> parts;             ///< of the model: whether their solids start strained from there
  bool of_part(Index part) const { return !parts.empty() && parts[static_cast<std::size_t>(part)] != 0; }
  /// The motion from there to the positions of `world` along straight lines, in small steps that take so long
  /// that no rate matters: `take` gets `mesh` with positions and velocities of each, and its dt.
  void go_to(const World& world, const SolidMesh& mesh,
             const std::function<void(const SolidMesh&, Real)>& take) const;
};

void report_inside_out(const ModelPart& part, Id solid, Diagnostics& diagnostics);

/// *INITIAL_FOAM_REFERENCE_GEOMETRY with the REF of materials; `node_of`: the node of the world of each node
/// of the model. Parts none of nodes one of these cards has start without stress.
ReferenceGeometry reference_geometry(const Deck& deck, const Model& model,
                                     const std::vector<SolidPart>& parts, const std::vector<Index>& node_of,
                                     const World& world, Diagnostics& diagnostics);

}  // namespace courant
