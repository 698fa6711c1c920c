#pragma once
// Tetrahedra whose change of volume is averaged over their nodes (ELFORM 13), so that bodies which keep their
// volume do not lock.
#include <memory>

#include "elements/erosion.hpp"
#include "elements/solid/solid_loops.hpp"
#include "state/world.hpp"

namespace courant {

/// After Bonet & Burton (1998, Commun. Numer. Meth. Eng. 14, 437), by work. With sums over the elements e of
/// a part at node a and means over the four nodes of an element,
///   J_a = sum_e V_e / sum_e V0_e,  J_e' = mean_a J_a,
/// and the law sees J_e' and its rate instead of those of the element. Of its mean stress -p_e, with the
/// bulk viscosity in it,
///   P_a = sum_e p_e V0_e / sum_e V0_e,  p_e' = mean_a P_a
/// pushes the corners, through dV_e/dx: what the law takes, sum_e p_e V0_e dJ_e', is then what the nodes
/// give, sum_e p_e' dV_e.
class NodalPressure {
 public:
  /// Between the hooks of a block.
  struct Scratch {
    Real opened[block_size];  ///< V0 times the change of J_e' in the step [L3]
  };

  /// Adds fields to the group, whose reference volumes are known, and to the nodes. `relative_volume`: V/V0
  /// at the start.
  NodalPressure(const ElementGroup& group, Real relative_volume, World& world);

  /// Of the pass over the elements that calls the hooks.
  void declare(Accesses& a) const;
  /// Behind `strain` of the loops: the trace of D, and the compression. The mean stress works through
  /// `opened`: what that is more than in `strain` is added. With an equation of state (`heats`) that of
  /// `scratch` is made the same, and all that follows works through it.
  void strain(const ElementBlock& block, const SolidState& state, SolidScratch& scratch, Scratch& own) const;
  /// Behind the law: the same of the new stress; not with an equation of state.
  void work(const ElementBlock& block, const SolidState& state, SolidScratch& scratch,
            const Scratch& own) const;
  /// Behind the forces, once failed elements are known. `erosion`: null where nothing can fail.
  void keep(const ElementBlock& block, const SolidState& state, const Erosion* erosion) const;

  /// Makes it, with the passes before and behind that one.
  static std::shared_ptr<NodalPressure> add(const ElementGroup& group, Real relative_volume, World& world);

 private:
  struct Pass;
  struct Volumes;
  struct NodalVolumes;
  struct NodalPressures;
  struct Push;
  static constexpr int corners = 4;
  /// Over the elements at a node.
  Real sum_at(Index node, const Real* of_element) const;
  /// Over the nodes of an element.
  Real mean(Index e, const Real* of_node) const;
  /// 6 V, and 6 dV/dx of the corners but the first. [L3], [L2]
  Real edges(const World& world, Index e, Vec b[3]) const;

  const ElementGroup& group_;
  std::vector<int> corner_[corners];     ///< of the group's corners, those that differ, by element
  std::vector<Index> first_, element_;   ///< of each node in element_, and the end; elements at nodes
  Field<Real>& volume_;                  ///< now and a step ago
  Field<Real>& counted_;                 ///< V0; 0: deleted
  Field<Real>& pressure_;                ///< p_e V0_e
  Field<Real>&ratio_, &nodal_pressure_;  ///< of nodes: J_a now and a step ago; P_a
};

}  // namespace courant
