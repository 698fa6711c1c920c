#pragma once
// What moves by v += a dt, x += v dt: particles, nodes, and whatever else has these fields. Loads,
// constraints and motion are written once, for points.
#include "state/entities.hpp"

namespace courant {

struct Points {
  FieldSet* set;
  Field<Real>*x, *v, *f;  ///< [L], [L/T], [ML/T2]
  const Field<Real>* m;   ///< [M]
  const Field<Id>* id;
  const Field<Index>* part;    ///< index into the model's parts; null: they belong to none
  const Field<Index>* follow;  ///< != 0 where something else moves the point (a rigid body); null: nowhere

  const FieldSet& fields() const { return *set; }
};

inline Points points_of(Particles& p) {
  return {&p.fields, &p.x, &p.v, &p.f, &p.m, &p.id, &p.part, nullptr};
}
inline Points points_of(Nodes& n) {
  return {&n.fields, &n.x, &n.v, &n.f, &n.m, &n.id, &n.part, &n.follow};
}

}  // namespace courant
