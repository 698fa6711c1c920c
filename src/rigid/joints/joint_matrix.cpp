#include "rigid/joints/joint_matrix.hpp"

#include <algorithm>
#include <array>

#include <Eigen/OrderingMethods>

namespace courant {

void JointMatrix::arrange(Index rows, const std::vector<std::array<Index, 2>>& entries) {
  const auto n = static_cast<std::size_t>(rows);
  std::vector<Eigen::Triplet<double>> full, upper;
  for (Index row = 0; row < rows; ++row) full.emplace_back(row, row, 1.0);
  for (const auto& [i, j] : entries) full.emplace_back(i, j, 1.0), full.emplace_back(j, i, 1.0);
  Eigen::SparseMatrix<double> pattern(rows, rows);
  pattern.setFromTriplets(full.begin(), full.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  place_.resize(n);
  for (Index k = 0; k < rows; ++k) place_[static_cast<std::size_t>(order.indices()[k])] = static_cast<int>(k);
  for (const auto& entry : full)
    if (at(entry.row()) <= at(entry.col())) upper.emplace_back(at(entry.row()), at(entry.col()), 0.0);
  upper_.resize(rows, rows);
  upper_.setFromTriplets(upper.begin(), upper.end());
  find_tree();
}

void JointMatrix::find_tree() {
  const auto n = static_cast<int>(upper_.cols());
  const auto size = static_cast<std::size_t>(n);
  parent_.assign(size, -1), flag_.assign(size, -1), filled_.assign(size, 0), first_.assign(size + 1, 0);
  on_.assign(size, 0), inverse_.assign(size, 0), row_.assign(size, 0);
  for (int k = 0; k < n; ++k) {
    flag_[k] = k;
    for (Eigen::SparseMatrix<double>::InnerIterator entry(upper_, k); entry; ++entry)
      for (int i = static_cast<int>(entry.row()); i < k && flag_[i] != k; i = parent_[i]) {
        if (parent_[i] < 0) parent_[i] = k;
        ++filled_[i], flag_[i] = k;
      }
  }
  for (std::size_t k = 0; k < size; ++k) first_[k + 1] = first_[k] + filled_[k];
  below_.resize(static_cast<std::size_t>(first_[size])), value_.resize(below_.size());
}

void JointMatrix::clear() {
  std::fill_n(upper_.valuePtr(), upper_.nonZeros(), 0.0);
}

void JointMatrix::add(Index row, Index column, Real value) {
  const auto [low, high] = std::minmax({at(row), at(column)});
  upper_.coeffRef(low, high) += value;
}

void JointMatrix::factorise(const Eigen::VectorXd& scale, Real least) {
  const auto n = static_cast<int>(upper_.cols());
  std::vector<double> enough(static_cast<std::size_t>(n));
  for (Index k = 0; k < n; ++k) enough[static_cast<std::size_t>(at(k))] = least * scale[k];
  std::fill(flag_.begin(), flag_.end(), -1), std::fill(filled_.begin(), filled_.end(), 0);
  for (int k = 0; k < n; ++k) {
    int top = n;
    flag_[k] = k;
    for (Eigen::SparseMatrix<double>::InnerIterator entry(upper_, k); entry; ++entry) {
      row_[entry.row()] += entry.value();
      int length = 0;
      for (int i = static_cast<int>(entry.row()); flag_[i] != k; i = parent_[i])
        on_[length++] = i, flag_[i] = k;
      while (length > 0) on_[--top] = on_[--length];
    }
    double pivot = row_[k];
    row_[k] = 0;
    for (; top < n; ++top) {
      const int i = on_[top];
      const double y = row_[i], l = y * inverse_[i];
      row_[i] = 0;
      const int end = first_[i] + filled_[i];
      for (int p = first_[i]; p < end; ++p) row_[below_[p]] -= value_[p] * y;
      pivot -= l * y;
      below_[end] = k, value_[end] = l;
      ++filled_[i];
    }
    inverse_[k] = pivot > enough[k] ? 1 / pivot : 0;
  }
}

Eigen::VectorXd JointMatrix::solve(const Eigen::VectorXd& right) const {
  const auto n = static_cast<int>(upper_.cols());
  Eigen::VectorXd x(n), out(n);
  for (Index k = 0; k < n; ++k) x[at(k)] = right[k];
  for (int k = 0; k < n; ++k)
    for (int p = first_[k]; p < first_[k + 1]; ++p) x[below_[p]] -= value_[p] * x[k];
  for (int k = n - 1; k >= 0; --k) {
    x[k] *= inverse_[k];
    for (int p = first_[k]; p < first_[k + 1]; ++p) x[k] -= value_[p] * x[below_[p]];
  }
  for (Index k = 0; k < n; ++k) out[k] = x[at(k)];
  return out;
}

}  // namespace courant
