// Compiled once for each instruction set; see docs/architecture.md. Nothing here may be shared with other
// files. Loops without branches, so that they go through registers of several points.
#include <cmath>

#include "base/simd.hpp"
#include "laws/strength/plane_return.hpp"

namespace courant::COURANT_SIMD {

namespace {

void go(const PlaneElasticity& law, const PointBlock& block, Real* sum_before, PlaneReturn& r) {
  const Real across = law.lambda / (law.lambda + 2 * law.G), twice = 2 * law.G * block.dt;
  const Real common = law.lambda * (1 - across) * block.dt, far = 1e12 / (2 * law.G);
  constexpr Real small = 1e-3, none = 1e-300;
  const Real *dxx = block.rate[0], *dyy = block.rate[1], *dxy = block.rate[3], *dyz = block.rate[4],
             *dzx = block.rate[5];
  Real *xx = block.stress[0], *yy = block.stress[1], *xy = block.stress[3], *yz = block.stress[4],
       *zx = block.stress[5];
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real trace = common * (dxx[i] + dyy[i]);
    sum_before[i] = xx[i] + yy[i];
    xx[i] += trace + twice * dxx[i], yy[i] += trace + twice * dyy[i];
    xy[i] += twice * dxy[i], yz[i] += twice * dyz[i], zx[i] += twice * dzx[i];
    const Real sum = xx[i] + yy[i], difference = xx[i] - yy[i];
    r.P[i] = 0.25 * sum * sum;
    r.S[i] = 0.75 * difference * difference + 3 * (xy[i] * xy[i] + yz[i] * yz[i] + zx[i] * zx[i]);
    r.m[i] = r.low[i] = 0, r.high[i] = far;
    r.least[i] = small * std::sqrt(r.P[i] + r.S[i]) + none;
  }
}

void measure(const PlaneElasticity& law, Index count, const Real* before, PlaneReturn& r) {
  constexpr Real none = 1e-300;
  const Real of_f = law.of_f(), of_g = law.of_g();
#pragma omp simd
  for (Index i = 0; i < count; ++i) {
    const Real f = 1 / (1 + of_f * r.m[i]), g = 1 / (1 + of_g * r.m[i]);
    const Real p = r.P[i] * f * f, s = r.S[i] * g * g, q = std::sqrt(p + s);
    r.q[i] = q;
    r.fall[i] = (p * f * of_f + s * g * of_g) / (q > none ? q : none);
    r.plastic[i] = before[i] + 2.0 / 3 * r.m[i] * q;
  }
}

Real approach(Index count, PlaneReturn& r) {
  constexpr Real none = 1e-300, round_off = 1e-15;
  Real most = 0;
#pragma omp simd reduction(max : most)
  for (Index i = 0; i < count; ++i) {
    const Real over = r.q[i] - r.yield[i], size = over > 0 ? over : -over;
    const Real low = over > 0 ? r.m[i] : r.low[i], high = over > 0 ? r.high[i] : r.m[i];
    const Real steep = r.fall[i] + r.slope[i] * (2.0 / 3) * (r.q[i] - r.m[i] * r.fall[i]);
    const Real newton = r.m[i] + over / (steep > none ? steep : none), middle = 0.5 * (low + high);
    const Real within = newton >= low && newton <= high ? newton : middle;
    const Real next = r.yield[i] > 0 ? within : high;  // softening has left no strength
    const Real scale = r.yield[i] + r.least[i];
    const bool open = high > low && size > round_off * scale;
    r.low[i] = low, r.high[i] = high;
    r.m[i] = open ? next : r.m[i];
    const Real left = open ? size / scale : 0;
    most = left > most ? left : most;
  }
  return most;
}

void settle(const PlaneElasticity& law, const PointBlock& block, Real* rate_zz, const PlaneReturn& r) {
  const Real bulk = 1 / ((3 * law.lambda + 2 * law.G) * block.dt), of_f = law.of_f(), of_g = law.of_g();
  const Real *dxx = block.rate[0], *dyy = block.rate[1];
  Real *xx = block.stress[0], *yy = block.stress[1], *xy = block.stress[3], *yz = block.stress[4],
       *zx = block.stress[5], *plastic = block.history[0];
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real f = 1 / (1 + of_f * r.m[i]), g = 1 / (1 + of_g * r.m[i]);
    const Real sum = f * (xx[i] + yy[i]), difference = g * (xx[i] - yy[i]);
    plastic[i] += 2.0 / 3 * r.m[i] * std::sqrt(r.P[i] * f * f + r.S[i] * g * g);
    xx[i] = 0.5 * (sum + difference), yy[i] = 0.5 * (sum - difference);
    xy[i] *= g, yz[i] *= g, zx[i] *= g;
    rate_zz[i] = (sum - rate_zz[i]) * bulk - dxx[i] - dyy[i];  // the volume changes elastically
  }
}

}  // namespace

PlaneReturnLoops plane_return_loops() {
  return {&go, &measure, &approach, &settle};
}

}  // namespace courant::COURANT_SIMD
