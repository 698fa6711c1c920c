#pragma once
// Damping of beams in proportion to their stiffness: forces on their ends besides those of the law.
#include "elements/beam/elastic_beam.hpp"
#include "elements/stiffness_damping.hpp"
#include "state/pass.hpp"

namespace courant {

class BeamDamping {
 public:
  /// Of a part: COEF, and the mechanisms of a range of frequencies; adds its fields where there are any.
  BeamDamping(Real coef, FrequencyRange range, const ElementGroup& group);
  bool any() const { return forces_ != nullptr; }
  void declare(Accesses& a) const;

  /// Of an element, whose deformation changes by `change` in a step and an elastic beam's forces by
  /// `elastic`: forces of damping, and in `work` the work that they do on it.
  Six forces(const Clock& clock, Index e, const Six& change, const Six& elastic, Real& work);
  /// Takes beta from the step without damping, and shortens it. [T]
  void shorten(Index e, Real& step);

 private:
  Real coef_;
  FrequencyRange range_;
  Field<Real>*forces_ = nullptr, *beta_ = nullptr;  ///< null: no damping; its forces, and its time [T]
  Field<Real>* mechanisms_ = nullptr;               ///< their forces; null: no range of frequencies
};

}  // namespace courant
