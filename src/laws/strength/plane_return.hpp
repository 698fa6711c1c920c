#pragma once
// Return to the surface of J2 plasticity in plane stress, for laws with isotropic hardening that follow
// Hooke's law below it. Loops without branches, so that they go through registers of several points.
#include <algorithm>
#include <cmath>
#include <limits>

#include "laws/point_block.hpp"
#include "parallel/parallel.hpp"

namespace courant {

/// Points of a block on their way to the surface (Simo & Taylor 1986, with transverse shear): with
/// P = (xx + yy)^2/4 and S = 3 (xx - yy)^2/4 + 3 (xy^2 + yz^2 + zx^2) of the trial stress,
/// q^2 = P/f^2 + S/g^2, f = 1 + E m/(3 (1 - nu)), g = 1 + 2 G m, and de = 2/3 m q, m the multiplier.
struct PlaneReturn {
  Real P[block_size], S[block_size];          ///< [M2/L2T4]
  Real m[block_size];                         ///< [LT2/M]
  Real q[block_size], plastic[block_size];    ///< at m, the plastic strain with de [M/LT2], [-]
  Real yield[block_size], slope[block_size];  ///< at that strain; d yield/de [M/LT2]
  Real fall[block_size], low[block_size], high[block_size];  ///< -dq/dm; m of a stress above, below the yield

  /// Finds m by Newton's method from 0, between bounds: one step where hardening is linear, as q falls ever
  /// slower. `harden(count, plastic, yield, slope)` fills the latter two.
  template <class Harden>
  void solve(Index count, Real of_f, Real of_g, const Real* before, const Harden& harden) {
    constexpr int rounds = 100;
    constexpr Real close = 1e-12, none = 1e-300, far = 1e12;
    for (Index i = 0; i < count; ++i) m[i] = low[i] = 0, high[i] = far / of_g;
    for (int k = 0; k < rounds; ++k) {
#pragma omp simd
      for (Index i = 0; i < count; ++i) {
        const Real f = 1 / (1 + of_f * m[i]), g = 1 / (1 + of_g * m[i]);
        const Real p = P[i] * f * f, s = S[i] * g * g;
        q[i] = std::sqrt(p + s);
        fall[i] = (p * f * of_f + s * g * of_g) / std::max(q[i], none);
        plastic[i] = before[i] + 2.0 / 3 * m[i] * q[i];
      }
      harden(count, plastic, yield, slope);
      Real most = 0;
#pragma omp simd reduction(max : most)
      for (Index i = 0; i < count; ++i) {
        const Real over = q[i] - yield[i];
        const bool above = over > 0;
        low[i] = above ? m[i] : low[i], high[i] = above ? high[i] : m[i];
        const Real steep = fall[i] + slope[i] * (2.0 / 3) * (q[i] - m[i] * fall[i]);
        const Real next = m[i] + over / std::max(steep, none);
        const bool within = next > low[i] && next < high[i];
        const Real open = low[i] < high[i] ? std::abs(over) : 0;
        const bool done = !(open > close * yield[i]);
        m[i] = done ? m[i] : within ? next : 0.5 * (low[i] + high[i]);
        most = std::max(most, done ? 0 : open);
      }
      if (!(most > 0)) return;
    }
  }
};

/// sigma and the plastic strain at the end of the step, and the rate zz without which there would be a stress
/// zz. [1/T]
template <class Harden>
void update_in_plane(Real lambda, Real G, const PointBlock& block, Real* rate_zz, const Harden& harden) {
  const Real across = lambda / (lambda + 2 * G), twice = 2 * G * block.dt;
  const Real common = lambda * (1 - across) * block.dt;
  const Real of_f = G * (3 * lambda + 2 * G) / (3 * (lambda + G)) / (1 - lambda / (2 * (lambda + G)));
  const Real *dxx = block.rate[0], *dyy = block.rate[1], *dxy = block.rate[3], *dyz = block.rate[4],
             *dzx = block.rate[5];
  Real *xx = block.stress[0], *yy = block.stress[1], *xy = block.stress[3], *yz = block.stress[4],
       *zx = block.stress[5], *plastic = block.history[0];
  PlaneReturn r;
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real trace = common * (dxx[i] + dyy[i]);
    rate_zz[i] = xx[i] + yy[i];  // the sum before, for now
    xx[i] += trace + twice * dxx[i], yy[i] += trace + twice * dyy[i];
    xy[i] += twice * dxy[i], yz[i] += twice * dyz[i], zx[i] += twice * dzx[i];
    const Real sum = xx[i] + yy[i], difference = xx[i] - yy[i];
    r.P[i] = 0.25 * sum * sum;
    r.S[i] = 0.75 * difference * difference + 3 * (xy[i] * xy[i] + yz[i] * yz[i] + zx[i] * zx[i]);
  }
  r.solve(block.count, of_f, 2 * G, plastic, harden);
  const Real bulk = 1 / ((3 * lambda + 2 * G) * block.dt);
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real f = 1 / (1 + of_f * r.m[i]), g = 1 / (1 + 2 * G * r.m[i]);
    const Real sum = f * (xx[i] + yy[i]), difference = g * (xx[i] - yy[i]);
    plastic[i] += 2.0 / 3 * r.m[i] * std::sqrt(r.P[i] * f * f + r.S[i] * g * g);
    xx[i] = 0.5 * (sum + difference), yy[i] = 0.5 * (sum - difference);
    xy[i] *= g, yz[i] *= g, zx[i] *= g;
    rate_zz[i] = (sum - rate_zz[i]) * bulk - dxx[i] - dyy[i];  // the volume changes elastically
  }
}

}  // namespace courant
