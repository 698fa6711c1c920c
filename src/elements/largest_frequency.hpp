#pragma once
#include <array>
#include <functional>
#include <vector>

#include "model/model.hpp"
#include "state/entities.hpp"

namespace courant {

/// Components of vectors over nodes: a number for each node.
using NodalVector = std::array<std::vector<Real>, 3>;

/// The nodes of a group alone, numbered from 0 in the order of the world's.
struct GroupNodes {
  /// `held`: axes along which nodes of the world are.
  GroupNodes(const ElementGroup& group, const std::vector<std::array<bool, 3>>& held, const Nodes& nodes);
  NodalVector x;                            ///< positions [L]
  std::vector<Real> m;                      ///< shares of the group's mass [M]
  std::vector<std::array<bool, 3>> held{};  ///< of each of them
  std::vector<std::vector<Index>> corner;   ///< of elements, by corner
  /// Sums of what elements have for their corners, component 3 c + k of corner c, times a factor, into the
  /// entries from `first` on.
  void assemble(const Field<Real>& of_corners, Real factor, NodalVector& sums) const;
  /// The same of what they left for their nodes by block. `place_node`: as nodes_of_places gives it.
  void assemble(const Field<Real>& of_blocks, const std::vector<Index>& place_node, Real factor,
                NodalVector& sums, std::size_t first) const;
  /// Of each position of BlockSums the node, numbered as here.
  std::vector<Index> nodes_of_places(const BlockSums& sums) const;

 private:
  std::vector<Index> used_;  ///< nodes of the world, ascending
};

/// The largest omega with K u = omega^2 M u, K symmetric, M of the masses of nodes `m` (0: the node has no
/// part in it), by Lanczos' method from a fixed random start: from below, within about a percent where there
/// are many modes of almost that frequency. `stiffness(u, Ku)` may rely on components of u being about `size`
/// [L]; axes of `held` nodes stay where they are. [1/T]
Real largest_frequency(const std::vector<Real>& m, const std::vector<std::array<bool, 3>>& held, Real size,
                       const std::function<void(const NodalVector& u, NodalVector& Ku)>& stiffness);

/// The share of the elements' own step `step` [T] that is taken: `asked`, and below 2/omega where `omega`
/// [1/T], as largest_frequency gives it, and the step are above 0.
Real below_frequency(Real asked, Real step, Real omega);

/// Axes along which the deck holds nodes of the world. `node_of`: the node of the world of each node of the
/// model.
std::vector<std::array<bool, 3>> held_at_start(const Model& model, const std::vector<Index>& node_of,
                                               const Nodes& nodes);

}  // namespace courant
