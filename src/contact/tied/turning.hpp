#pragma once
// Rotations of tied nodes.
#include <algorithm>

#include "contact/tied/constraint.hpp"
#include "state/shared_fields.hpp"

namespace courant {

/// Rotations of nodes, if the scene has them and ties need them.
struct TurningFields {
  Field<Real>*angle = nullptr, *speed = nullptr, *moment = nullptr, *inertia = nullptr;
  Field<Index>* none = nullptr;
  TurningFields(const TiedConstraint& tied, const World& world) {
    if (std::find(tied.turns.begin(), tied.turns.end(), 1) == tied.turns.end()) return;
    const FieldSet& nodes = world.nodes.fields;
    angle = shared_fields::rotation.find(nodes), speed = shared_fields::angular_velocity.find(nodes);
    moment = shared_fields::moment.find(nodes), inertia = shared_fields::rotary_inertia.find(nodes);
    none = shared_fields::no_rotation.find(nodes);
  }
  explicit operator bool() const { return angle != nullptr; }
};

inline Vec mean_of(const FacePoint& at, const Field<Real>& value) {
  Vec out = Vec::Zero();
  for (std::size_t e = 0; e < static_cast<std::size_t>(at.corners); ++e)
    out += at.N[e] * value.vec(at.node[e]);
  return out;
}

}  // namespace courant
