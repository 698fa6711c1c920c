#pragma once
#include "base/real.hpp"

namespace courant {

/// Least eigenvalue of a symmetric matrix, in closed form, to some 1e-8 of the largest one.
Real least_eigenvalue(const Eigen::Matrix2d& M);
Real least_eigenvalue(const Matrix& M);

}  // namespace courant
