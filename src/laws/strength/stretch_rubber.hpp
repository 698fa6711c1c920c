#pragma once
// Rubber by the stretches without their change of volume.
#include <cmath>
#include <Eigen/Eigenvalues>

#include "laws/strength/left_cauchy_green.hpp"

namespace courant {

/// Along the principal directions, for W without the change of volume, l the stretches: l dW/dl, and l^2
/// d2W/dl2. [M/LT2]
struct PrincipalForces {
  Vec first, second;
};

/// Stress and sound speed of point i for W(l1, l2, l3) + K (J - 1 - ln J), l = J^(-1/3) times the stretches:
/// sigma_i = (l_i dW/dl_i)/J + K (1 - 1/J); waves along i have rho0 c^2 = l_i^2 d2W/dl_i^2 + K, also where
/// rubber is stretched. `forces`: of l, whose product is 1.
template <class Forces>
void answer_stretches(const PointBlock& block, Index i, Real K, Real ro, const Forces& forces) {
  const Matrix b = strained(block, i).matrix();
  const Eigen::SelfAdjointEigenSolver<Matrix> principal(b);
  const Vec l = principal.eigenvalues().cwiseSqrt();
  const Real J = l.prod();
  const PrincipalForces f = forces(Vec(l / std::cbrt(J)));
  const Vec along = f.first / J + Vec::Constant(K * (1 - 1 / J));
  const Matrix s = principal.eigenvectors() * along.asDiagonal() * principal.eigenvectors().transpose();
  const Real out[6] = {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)};
  for (std::size_t k = 0; k < 6; ++k) block.stress[k][i] = out[k];
  block.sound_speed[i] = std::sqrt((f.second.maxCoeff() + K) / ro);
}

}  // namespace courant
