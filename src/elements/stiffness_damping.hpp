#pragma once
// *DAMPING_PART_STIFFNESS and *DAMPING_FREQUENCY_RANGE_DEFORM: stress against the rate of strain, in
// proportion to the elastic stiffness.
#include <memory>
#include <vector>

#include "keyword/deck.hpp"
#include "laws/point_block.hpp"
#include "laws/strength/strength.hpp"
#include "loads/frequency_range.hpp"
#include "model/model.hpp"
#include "state/entities.hpp"

namespace courant {

/// COEF of each part of the model, 0 where there is none: > 0 the fraction of critical damping at the highest
/// frequency of an element [-]; < 0 minus Rayleigh's beta [T]. `laws`: null where a part has no elements that
/// deform; `by_pressure`: parts whose solids have their pressure from an equation of
/// state or from nodes.
std::vector<Real> stiffness_damping(const Deck& deck, const Model& model,
                                    const std::vector<std::shared_ptr<StrengthLaw>>& laws,
                                    const std::vector<bool>& by_pressure, Diagnostics& diagnostics);

/// Mechanisms of *DAMPING_FREQUENCY_RANGE_DEFORM of each part, with the same arguments.
std::vector<FrequencyRange> stress_ranges(const Deck& deck, const Model& model,
                                          const std::vector<std::shared_ptr<StrengthLaw>>& laws,
                                          const std::vector<bool>& by_pressure, Diagnostics& diagnostics);

/// The share of a stable step that is left by damping in proportion to stiffness: velocities lag half a step,
/// so dt <= (2/w) (sqrt(1 + z^2) - z) with z = beta w/2 at the highest frequency w = 2/dt_0, that is beta
/// over the step `undamped` = dt_0. [-]; docs/theory_bodies.md
Real damped_share(Real beta, Real undamped);
/// The same of mechanisms, which add to the stiffness at the highest frequency.
Real stiffened_share(const FrequencyRange& range);

/// Elements of a group: the stress sigma + beta C:D, with C of Hooke's law by the bulk and shear modulus at
/// rest, pushes the nodes, while the law goes on with sigma. beta = COEF dt_0 with the step dt_0 of an
/// element without damping, or -COEF. Besides, the stress s_k of each mechanism of a range of frequencies,
/// with s_k' = c_k C:D - s_k/tau_k.
class StiffnessDamping {
 public:
  /// Adds its fields. `points`: of each element; `tensors`: of them keeps the stress of damping (of solids).
  StiffnessDamping(Real coef, FrequencyRange range, const ElementGroup& group, int points, int tensors);
  void declare(Accesses& a) const;
  /// Component k of the sum at a point, over the group; solids show one point at a time. [M/LT2]
  Real* damped(int point, int k) const { return damped_.data(6 * point + k); }
  Real beta(Index e) const { return beta_[e]; }  ///< [T]

  /// What a block of solids needs besides its points.
  struct SolidBlock {
    Index begin;
    const Real* half_turn[3];  ///< of the step [-]
    const Real* volume;        ///< of the point in the middle of the step [L3]
    Real* work;                ///< the half that the old stress does is added [ML2/T2]
  };
  void add(const StrengthLaw& law, int point, const PointBlock& points, const SolidBlock& of) const;
  /// Points of shells, whose stress is plane.
  void add_in_plane(const StrengthLaw& law, int point, const PointBlock& points, Index begin) const;

  /// Behind the forces: makes the steps of a block shorter and takes beta from the steps without damping. [T]
  void shorten(Index begin, Index count, const Real* undamped, Real* step_limit) const;

 private:
  Real& mechanism(int point, std::size_t k, int component, Index e) const {
    return mechanisms_->data(6 * (point * static_cast<int>(range_.time.size()) + static_cast<int>(k)) +
                             component)[e];
  }

  void turn_mechanisms(int point, Index e, const Vec& half_turn) const;
  /// beta times the rate of elastic stress, and the stress of the mechanisms, which go on by a step.
  Real damping_stress(int point, int component, Index e, Real elastic_rate, const FrequencyRange::Step& step,
                      Real dt) const;

  Real coef_;
  FrequencyRange range_;
  Field<Real>& beta_;                  ///< of each element [T]
  Field<Real>& damped_;                ///< the sum
  Field<Real>* damping_ = nullptr;     ///< stress of damping of solids, of each point
  Field<Real>* mechanisms_ = nullptr;  ///< null: no range of frequencies
};

}  // namespace courant
