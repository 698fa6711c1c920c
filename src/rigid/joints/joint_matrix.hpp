#pragma once
#include <array>
#include <vector>

#include <Eigen/SparseCore>

#include "base/real.hpp"

namespace courant {

/// A sparse symmetric matrix without negative eigenvalues as L D L^T (up-looking, Davis 2005). Rows that
/// follow from others, whose pivot all but vanishes, are left out: their unknown is 0.
class JointMatrix {
 public:
  /// Positions of non-zero entries: pairs of rows.
  void arrange(Index rows, const std::vector<std::array<Index, 2>>& entries);
  void clear();                                   ///< all entries are 0
  void add(Index row, Index column, Real value);  ///< to an entry, and to the one opposite to it
  /// Leaves rows out whose pivot is no more than `least` of `scale`, which has a value for each row.
  void factorise(const Eigen::VectorXd& scale, Real least);
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  /// Of the last factorisation.
  bool left_out(Index row) const { return inverse_[static_cast<std::size_t>(at(row))] == 0; }
  /// 0 of rows that are left out.
  Real pivot(Index row) const { return left_out(row) ? 0 : 1 / inverse_[static_cast<std::size_t>(at(row))]; }

 private:
  int at(Index row) const { return place_[static_cast<std::size_t>(row)]; }
  void find_tree();

  std::vector<int> place_;                                        ///< of each row in the order of elimination
  Eigen::SparseMatrix<double> upper_;                             ///< in that order
  std::vector<int> parent_, first_, filled_, below_, flag_, on_;  ///< of L by columns, and the tree
  std::vector<double> value_, inverse_, row_;                     ///< of L, of D, room for a row
};

}  // namespace courant
