#pragma once
#include "state/shared_fields.hpp"
#include "state/world.hpp"

namespace courant {

/// Fields of sub-cycling (state/subcycle.hpp); where there is none they are not registered.
namespace subcycle_fields {
/// Sum of forces between particles, of the last outer step
inline const SharedField<Real> pair_force({.name = "pair_force", .dimension = "ML/T2", .components = 3});
/// Position at the last outer step
inline const SharedField<Real> outer_position({.name = "outer_position", .dimension = "L", .components = 3});
/// Mean velocity since the last outer step
inline const SharedField<Real> mean_velocity(
    {.name = "mean_velocity", .dimension = "L/T", .components = 3, .restart = false, .exchange = true});
}  // namespace subcycle_fields

/// What passes between particles take for velocity and force: with sub-cycling the mean velocity since the
/// last outer step, and the sum of the slow forces; otherwise those of the step.
struct PairMotion {
  explicit PairMotion(Particles& p)
      : v(or_else(subcycle_fields::mean_velocity.find(p.fields), p.v)),
        f(or_else(subcycle_fields::pair_force.find(p.fields), p.f)) {}
  Field<Real>&v, &f;

 private:
  static Field<Real>& or_else(Field<Real>* first, Field<Real>& second) { return first ? *first : second; }
};

}  // namespace courant
