#pragma once
// Rigid bodies of nodes: *CONSTRAINED_NODAL_RIGID_BODY, and welds without failure.
#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "keyword/deck.hpp"
#include "model/mesh/part_inertia.hpp"
#include "model/model.hpp"

namespace courant {

/// Nodes that move as one rigid body, whose mass is that of its nodes, or given.
struct NodalBody {
  Id id = 0;         ///< among the parts; of welds one that no part has
  std::string name;  ///< "nodal rigid body 7"
  Entry card{};
  std::vector<Index> nodes{};             ///< indices into Model::nodes, ascending
  Index output_node = -1;                 ///< PNODE: goes with the body
  std::array<bool, 3> held{}, no_turn{};  ///< global axes without translation, rotation
  std::optional<PartInertiaCard> given{};
};

/// Numbers of those of *CONSTRAINED_NODAL_RIGID_BODY.
std::set<Id> nodal_body_ids(const Deck& deck, const Model& model);

/// In the order of the deck: first those of *CONSTRAINED_NODAL_RIGID_BODY. Refuses by name: sets and nodes
/// that are not there, particles, constraints along local axes.
std::vector<NodalBody> nodal_bodies(const Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace courant
