#pragma once
// Return to the surface of J2 plasticity, for laws that follow Hooke's law below it. Loops without branches,
// so that they go through registers of several points.
#include <algorithm>
#include <cmath>

#include "laws/point_block.hpp"
#include "parallel/parallel.hpp"

namespace courant {

/// Of points of a block: q = sqrt(3/2 xi:xi) of the trial state, xi = s - alpha, and what the law makes of
/// it.
struct PlasticTrial {
  Real q[block_size], plastic[block_size];  ///< [M/LT2]; increment of effective plastic strain [-]
};

/// The centre of the yield surface: one that moves, by component of the back stress, and one that does not.
struct MovingCentre {
  Real* const* alpha;
  Real at(int k, Index i) const { return alpha[k][i]; }
  void add(int k, Index i, Real by) const { alpha[k][i] += by; }
};
struct FixedCentre {
  Real at(int, Index) const { return 0; }
  void add(int, Index, Real) const {}
};

/// sigma += (lambda tr(D) 1 + 2 G D) dt, and its q.
template <class Centre>
void go_elastically(Real lambda, Real G, const PointBlock& block, const Centre& centre, PlasticTrial& trial) {
  const Real volumetric = lambda * block.dt, twice = 2 * G * block.dt;
  const Real *dxx = block.rate[0], *dyy = block.rate[1], *dzz = block.rate[2], *dxy = block.rate[3],
             *dyz = block.rate[4], *dzx = block.rate[5];
  Real *xx = block.stress[0], *yy = block.stress[1], *zz = block.stress[2], *xy = block.stress[3],
       *yz = block.stress[4], *zx = block.stress[5];
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real common = volumetric * (dxx[i] + dyy[i] + dzz[i]);
    xx[i] += common + twice * dxx[i], yy[i] += common + twice * dyy[i], zz[i] += common + twice * dzz[i];
    xy[i] += twice * dxy[i], yz[i] += twice * dyz[i], zx[i] += twice * dzx[i];
    const Real mean = (xx[i] + yy[i] + zz[i]) / 3;
    const Real a = xx[i] - mean - centre.at(0, i), b = yy[i] - mean - centre.at(1, i),
               c = zz[i] - mean - centre.at(2, i), d = xy[i] - centre.at(3, i), e = yz[i] - centre.at(4, i),
               f = zx[i] - centre.at(5, i);
    trial.q[i] = std::sqrt(1.5 * (a * a + b * b + c * c) + 3 * (d * d + e * e + f * f));
  }
}

/// s -= 3 G (de/q) xi; the centre moves by `kinematic` (de/q) xi. `least`: what q is where de > 0, or less.
/// [M/LT2]
template <class Centre>
void return_radially(Real G, Real kinematic, Real least, const PointBlock& block, const Centre& centre,
                     const PlasticTrial& trial) {
  Real *xx = block.stress[0], *yy = block.stress[1], *zz = block.stress[2], *xy = block.stress[3],
       *yz = block.stress[4], *zx = block.stress[5];
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real mean = (xx[i] + yy[i] + zz[i]) / 3;
    const Real share = trial.plastic[i] / std::max(trial.q[i], least), back = 3 * G * share,
               forth = kinematic * share;
    const Real a = xx[i] - mean - centre.at(0, i), b = yy[i] - mean - centre.at(1, i),
               c = zz[i] - mean - centre.at(2, i), d = xy[i] - centre.at(3, i), e = yz[i] - centre.at(4, i),
               f = zx[i] - centre.at(5, i);
    xx[i] -= back * a, yy[i] -= back * b, zz[i] -= back * c;
    xy[i] -= back * d, yz[i] -= back * e, zx[i] -= back * f;
    centre.add(0, i, forth * a), centre.add(1, i, forth * b), centre.add(2, i, forth * c);
    centre.add(3, i, forth * d), centre.add(4, i, forth * e), centre.add(5, i, forth * f);
  }
}

/// sqrt(2/3 D:D) of the rate of strain of point i, or with `of_deviator` of its deviator: in uniaxial stress
/// at constant volume that of the axis. [1/T]
inline Real effective_rate(const PointBlock& block, Index i, bool of_deviator) {
  const auto& D = block.rate;
  const Real mean = of_deviator ? (D[0][i] + D[1][i] + D[2][i]) / 3 : 0;
  const Real a = D[0][i] - mean, b = D[1][i] - mean, c = D[2][i] - mean;
  return std::sqrt(2.0 / 3 * (a * a + b * b + c * c) +
                   4.0 / 3 * (D[3][i] * D[3][i] + D[4][i] * D[4][i] + D[5][i] * D[5][i]));
}

}  // namespace courant
