#pragma once
// Forces of elements on their nodes, summed by block.
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "state/field.hpp"

namespace courant {

/// Sums over the elements of each block of their contributions to a node. Elements of a block share nodes:
/// where neighbours are consecutive there are about as many sums as elements, a fourth of the corners.
/// Positions of sums: the nodes of the first block, ascending, then those of the second, ...
class BlockSums {
 public:
  /// `node`: of the corners of elements. `set`: name of the set of the fields.
  BlockSums(const Field<Index>& node, Index elements, const std::string& set);
  BlockSums(const BlockSums&) = delete;

  /// The sums of a block. `of_corners`: of corner c in direction k at 3 c + k, of its first element, of the
  /// second, ...
  void set(Field<Real>& sums, Index begin, Index count, const Real (*of_corners)[block_size]) const;

  const std::vector<Index>& nodes() const { return nodes_; }  ///< of each position
  Field<Real> force, moment;                                  ///< on nodes [ML/T2], [ML2/T2]

 private:
  std::vector<Index> first_;                       ///< start of each block, and the end
  std::vector<Index> nodes_;                       ///< of each position
  std::vector<std::vector<std::uint16_t>> place_;  ///< of each element in its block, by corner
};

}  // namespace courant
