#pragma once
// Entities that move by v += a dt, x += v dt: particles, nodes, and others with these fields. Loads,
// constraints and motion are written once, for points.
#include "state/entities.hpp"
#include "state/shared_fields.hpp"

namespace courant {

struct Points {
  FieldSet* set;
  Field<Real>*x, *v, *f;  ///< [L], [L/T], [ML/T2]
  const Field<Real>* m;   ///< [M]
  const Field<Id>* id;
  const Field<Index>* part;    ///< index into the model's parts; null: of no part
  const Field<Index>* follow;  ///< != 0 where another pass moves the point (a rigid body); null: nowhere

  bool turns = false;  ///< these are rotations of the points: angles, angular velocities, moments

  const FieldSet& fields() const { return *set; }
  std::string name() const { return (turns ? "rotations of " : "") + set->name(); }
  const SharedField<Index>& held() const {
    return turns ? shared_fields::held_rotations : shared_fields::held_axes;
  }
  const SharedField<Index>& driven() const {
    return turns ? shared_fields::prescribed_rotation : shared_fields::prescribed_motion;
  }
  const SharedField<Real>& driven_projector() const {
    return turns ? shared_fields::driven_rotation_projector : shared_fields::driven_projector;
  }
  const SharedField<Real>& driven_change() const {
    return turns ? shared_fields::driven_rotation_change : shared_fields::driven_change;
  }
};

inline Points points_of(Particles& p) {
  return {&p.fields, &p.x, &p.v, &p.f, &p.m, &p.id, &p.part, nullptr};
}
inline Points points_of(Nodes& n) {
  return {&n.fields, &n.x, &n.v, &n.f, &n.m, &n.id, &n.part, &n.follow};
}

/// Whether a scene has rotations of nodes: shells that deform register them.
inline bool has_rotations(const Nodes& n) {
  return shared_fields::rotary_inertia.find(n.fields) != nullptr;
}
/// They obey the same equation: moments are their forces, rotary inertia their mass. Only where a scene has
/// them.
inline Points rotations_of(Nodes& n) {
  return {&n.fields,
          shared_fields::rotation.find(n.fields),
          shared_fields::angular_velocity.find(n.fields),
          shared_fields::moment.find(n.fields),
          shared_fields::rotary_inertia.find(n.fields),
          &n.id,
          &n.part,
          shared_fields::no_rotation.find(n.fields),
          true};
}

}  // namespace courant
