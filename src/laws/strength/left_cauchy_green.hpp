#pragma once
// b = F F^T of points of a block, for laws whose stress follows from the stretches since the start.
#include "laws/strength/strength.hpp"

namespace courant {

/// Symmetric tensors xx yy zz xy yz zx of one point.
struct Symmetric {
  Real xx, yy, zz, xy, yz, zx;
  Real trace() const { return xx + yy + zz; }
  Real determinant() const {
    return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
  }
  Symmetric squared() const {
    return {xx * xx + xy * xy + zx * zx, xy * xy + yy * yy + yz * yz, zx * zx + yz * yz + zz * zz,
            xx * xy + xy * yy + zx * yz, xy * zx + yy * yz + yz * zz, zx * xx + yz * xy + zz * zx};
  }
  Matrix matrix() const {
    Matrix m;
    m << xx, xy, zx, xy, yy, yz, zx, yz, zz;
    return m;
  }
};

/// What such laws keep, as their first history variable: b - 1, turned with the body.
inline const HistoryVariable left_cauchy_green{"left_cauchy_green_less_1", "-", 6};

/// b of point i at the end of the step, which it grows to by A b A^T, A = (1 - D dt/2)^-1 (1 + D dt/2); kept.
inline Symmetric strained(const PointBlock& block, Index i) {
  const auto& D = block.rate;
  const auto& kept = block.history;
  const Symmetric b{1 + kept[0][i], 1 + kept[1][i], 1 + kept[2][i], kept[3][i], kept[4][i], kept[5][i]};
  const Symmetric half{0.5 * block.dt * D[0][i], 0.5 * block.dt * D[1][i], 0.5 * block.dt * D[2][i],
                       0.5 * block.dt * D[3][i], 0.5 * block.dt * D[4][i], 0.5 * block.dt * D[5][i]};
  const Matrix H = half.matrix();
  const Matrix A = (Matrix::Identity() - H).inverse() * (Matrix::Identity() + H);
  const Matrix now = A * b.matrix() * A.transpose();
  const Symmetric out{now(0, 0), now(1, 1), now(2, 2), now(0, 1), now(1, 2), now(2, 0)};
  kept[0][i] = out.xx - 1, kept[1][i] = out.yy - 1, kept[2][i] = out.zz - 1;
  kept[3][i] = out.xy, kept[4][i] = out.yz, kept[5][i] = out.zx;
  return out;
}

}  // namespace courant
