#pragma once
#include <vector>

#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// Rotations of nodes (state/shared_fields.hpp), registered by the first pass with elements that have
/// moments.
struct NodalRotations {
  Field<Real>&angle, &speed, &moment, &inertia;
  Field<Index>& none;
  explicit NodalRotations(FieldSet& nodes);
};

/// Once rigid bodies have their nodes: which of the nodes turn freely, and their initial angular velocities.
void start_rotations(const Model& model, const std::vector<Index>& node_of, World& world);

}  // namespace courant
