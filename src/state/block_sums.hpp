#pragma once
// What elements leave for their nodes, summed up block by block.
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "state/field.hpp"

namespace courant {

/// Sums of what the elements of each block have for a node. Elements of a block share nodes: where
/// neighbours stand one behind the other there are about as many sums as elements, a fourth of the corners.
/// Places are those of the nodes of the first block, ascending, then those of the second, ...
class BlockSums {
 public:
  /// `node`: of the corners of elements. `set`: what the fields belong to.
  BlockSums(const Field<Index>& node, Index elements, const std::string& set);
  BlockSums(const BlockSums&) = delete;

  /// The sums of a block. `of_corners`: of corner c in direction k at 3 c + k, of its first element, of the
  /// second, ...
  void set(Field<Real>& sums, Index begin, Index count, const Real (*of_corners)[block_size]) const;

  const std::vector<Index>& nodes() const { return nodes_; }  ///< of each position
  Field<Real> force, moment;                                  ///< on nodes [ML/T2], [ML2/T2]

 private:
  std::vector<Index> first_;                       ///< place of each block, and the end
  std::vector<Index> nodes_;                       ///< of each position
  std::vector<std::vector<std::uint16_t>> place_;  ///< of each element in its block, by corner
};

}  // namespace courant
