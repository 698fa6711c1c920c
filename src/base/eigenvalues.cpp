#include "base/eigenvalues.hpp"

#include <cmath>
#include <Eigen/Eigenvalues>

namespace courant {

Real least_eigenvalue(const Eigen::Matrix2d& M) {
  const Real half_difference = 0.5 * (M(0, 0) - M(1, 1));
  return 0.5 * M.trace() - std::sqrt(half_difference * half_difference + M(0, 1) * M(0, 1));
}

Real least_eigenvalue(const Matrix& M) {
  Eigen::SelfAdjointEigenSolver<Matrix> solver;
  solver.computeDirect(M, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0];
}

}  // namespace courant
