#pragma once
// Cards about rigid bodies as wholes: nodes that are added to them, how they start, what pushes them.
#include <map>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "rigid/bodies/merge.hpp"

namespace courant {

/// *CONSTRAINED_EXTRA_NODES_NODE and _SET: nodes (indices into Model::nodes) that go with a part (index into
/// Model::parts), each with the card that names it. Refuses by name: sets and nodes that are not there, parts
/// that are not rigid, particles.
struct ExtraNode {
  Index node = 0;
  Entry card{};
  const char* field = "";
};
std::map<Index, std::vector<ExtraNode>> extra_nodes(const Deck& deck, const Model& model,
                                                    Diagnostics& diagnostics);

/// *INITIAL_VELOCITY_RIGID_BODY, in global axes.
struct BodyStart {
  Vec v = Vec::Zero(), omega = Vec::Zero();  ///< of the centre [L/T], [1/T]
};
/// By number of the part or body of nodes. Refuses by name: parts that are not rigid, or merged into others.
std::map<Id, BodyStart> body_starts(const Deck& deck, const Model& model, const BodyMerges& merges,
                                    Diagnostics& diagnostics);

/// One *LOAD_RIGID_BODY: a force at the centre or a moment.
struct BodyForceLoad {
  Id body = 0;                  ///< number of the part or body of nodes
  Vec direction = Vec::Zero();  ///< unit
  bool turns = false;           ///< a moment
  Curve curve{};                ///< of time
  Real sf = 1;                  ///< SF curve(t) [ML/T2], [ML2/T2]
};
/// Refuses by name: followers, curves of displacement, systems that move, parts that are not rigid, or merged
/// into others.
std::vector<BodyForceLoad> body_force_loads(const Deck& deck, const Model& model, const BodyMerges& merges,
                                            Diagnostics& diagnostics);

}  // namespace courant
