#pragma once
// What SPC, TC and RC of nodes mean for the rigid body that the nodes belong to.
#include <string>
#include <vector>

#include "model/model.hpp"
#include "rigid/bodies/rigid.hpp"

namespace courant {

/// How messages name a body, and what they advise.
struct BodyText {
  Location where{};
  std::string name;     ///< "rigid part 3"
  std::string instead;  ///< how to hold the body as a whole
};

bool is_constrained(const Model& model, const ModelNode& node);

/// SPC, TC and RC of nodes hold the body where that is the same as holding motions of its centre and turns
/// about it along global axes: where of the motions that they forbid, as many are such ones as there are.
/// Warns of that, and refuses other constraints by name.
void hold_by_nodes(const Model& model, const std::vector<const ModelNode*>& constrained, const World& world,
                   const BodyText& text, RigidBody& body, Diagnostics& diagnostics);

}  // namespace courant
