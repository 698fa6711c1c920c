#pragma once
// Stress and history at the points of solids of a part that have several.
#include <array>
#include <functional>
#include <vector>

#include "elements/element_report.hpp"
#include "elements/point_strains.hpp"
#include "elements/solid/formulation.hpp"
#include "elements/solid/solid_pressure.hpp"
#include "laws/most_history.hpp"
#include "laws/strength/strength.hpp"
#include "state/entities.hpp"

namespace courant {

class StiffnessDamping;

class FullPoints {
 public:
  /// The motion of a block of elements and its forces. Stress and tensors of `state` are ignored.
  struct BlockOfSolids {
    const SolidMesh& mesh;
    const SolidControl& control;
    const SolidState& state;
    const StrengthLaw& law;
  };
  /// Of an equation of state: one pressure for all points of an element, of its mean compression and its
  /// energy. A point that has failed has no deviator; the pressure stays until the element goes.
  struct Fluid {
    const SolidPressure& law;
    const Real* energy;             ///< internal, of the elements [ML2/T2]
    Real* memory;                   ///< as of SolidPressure::split
    SolidPressure::Faults found{};  ///< out
  };
  /// What happens behind the gathering of the corners, and behind the law at each point.
  struct Between {
    std::function<void()> gathered;
    std::function<void(int point, const PointBlock& points)> answered;
  };

  /// Adds fields to the group.
  FullPoints(const SolidFormulation& formulation, const ElementGroup& group, const StrengthLaw& law);
  int points() const { return points_; }
  /// A tensor of six numbers for each point, which is turned with the stress.
  void turn_too(Field<Real>& tensor) { tensors_.push_back(&tensor); }
  /// Null: by none.
  void damp_by(const StiffnessDamping* damping) { damping_ = damping; }
  void declare(Accesses& a) const;
  StableStep advance(const BlockOfSolids& of, const ElementBlock& block, PointScratch& scratch,
                     const Between& between) const;
  /// The same with an equation of state.
  StableStep advance(const BlockOfSolids& of, Fluid& fluid, const ElementBlock& block, PointScratch& scratch,
                     const Between& between) const;
  /// Volumes, with reference volumes of 1, and steps of elements without stress.
  void measure(const BlockOfSolids& of, const ElementBlock& block, Real sound_speed,
               PointScratch& scratch) const;
  /// No stress, no history.
  void reset();
  /// What all points of an element have of a tensor of the law's history, the one with this number.
  void set_tensor(std::size_t number, Index e, const std::array<Real, 6>& tensor);
  /// What all points have of a number of the law's history, by element.
  void set_number(std::size_t number, const Field<Real>& value);
  /// At the start, of an equation of state. Adds a field. [M/LT2]
  void start_pressure(Real p);
  /// Means over the points. `history`: a field for each number of the law, as the law has them.
  void average(Field<Real>& stress, const std::vector<Field<Real>*>& history) const;
  /// The points of an element, or their mean, without plastic strains. `strains`: null: there are none.
  std::vector<PointReport> report(Index e, bool all_points, const PointStrains* strains) const;
  /// Those that are 0 in deleted elements.
  std::vector<Field<Real>*> of_deleted() const;

 private:
  /// What the law gets at point p, whose stress and tensors `state` then has. `history`: room.
  PointBlock at_point(int p, const ElementBlock& block, PointScratch& scratch, SolidState& state,
                      std::array<Real*, most_history>& history) const;
  const ElementGroup& group_;
  int points_;
  PointLoops loops_;
  Field<Real>& stress_;                ///< component 6 p + k of point p
  std::vector<Field<Real>*> history_;  ///< of each number of the law, component n p + k
  std::vector<Field<Real>*> tensors_;  ///< those among them, and others
  Field<Real>* pressure_ = nullptr;    ///< of an equation of state, by element; null: none
  const StiffnessDamping* damping_ = nullptr;
};

}  // namespace courant
