// Compiled once for each instruction set; see docs/architecture.md. Nothing here may be shared with other
// files, so there is no function of the standard library but the root, which is an instruction. Comparisons
// stand so that what is not a number stays so.
#include "state/particle_loops.hpp"

#include "base/simd.hpp"

namespace courant::COURANT_SIMD {

namespace {

void kick(Real* __restrict v, const Real* __restrict f, const Real* __restrict m, Real dt, Index begin,
          Index end) {
  for (Index i = begin; i < end; ++i) v[i] += f[i] / m[i] * dt;
}

void drift(Real* __restrict x, const Real* __restrict v, Real dt, Index begin, Index end) {
  for (Index i = begin; i < end; ++i) x[i] += v[i] * dt;
}

Real fastest2(const Real* const v[3], Index begin, Index end) {
  const Real *vx = v[0], *vy = v[1], *vz = v[2];
  Real most = 0;
#pragma omp simd reduction(max : most)
  for (Index i = begin; i < end; ++i) {
    const Real v2 = vx[i] * vx[i] + vy[i] * vy[i] + vz[i] * vz[i];
    most = most < v2 ? v2 : most;
  }
  return most;
}

Real least_crossing(const Real* h, const Real* c, const Real* const v[3], Index begin, Index end) {
  const Real *vx = v[0], *vy = v[1], *vz = v[2];
  Real least = __builtin_inf();
  int broken = 0;
#pragma omp simd reduction(min : least) reduction(| : broken)
  for (Index i = begin; i < end; ++i) {
    const Real dt = h[i] / (c[i] + __builtin_sqrt(vx[i] * vx[i] + vy[i] * vy[i] + vz[i] * vz[i]));
    least = dt < least ? dt : least;
    broken |= dt == dt ? 0 : 1;
  }
  return broken ? __builtin_nan("") : least;
}

template <bool Spatial, bool Grows>
ParticleLoops::Moved moved(const ParticleLoops::Places& q, Real reach, Index begin, Index end) {
  const Real *x = q.x[0], *y = q.x[1], *z = q.x[2], *h = q.h;
  const Real *xb = q.x_before[0], *yb = q.x_before[1], *zb = q.x_before[2], *hb = q.h_before;
  const Real support = q.support;
  Real most = 0;
  int beyond = 0;
#pragma omp simd reduction(max : most) reduction(| : beyond)
  for (Index i = begin; i < end; ++i) {
    const Real dx = x[i] - xb[i], dy = y[i] - yb[i], dz = Spatial ? z[i] - zb[i] : 0;
    const Real moved2 = dx * dx + dy * dy + dz * dz;
    const Real grown = Grows ? support * (h[i] - hb[i]) : 0, left = reach - (grown < 0 ? 0 : grown),
               room = left < 0 ? 0 : left;
    beyond |= moved2 < room * room ? 0 : 1;  // 1 also for NaN
    most = most < moved2 ? moved2 : most;
  }
  return {most, beyond == 0};
}
ParticleLoops::Moved moved(const ParticleLoops::Places& q, Real reach, Index begin, Index end) {
  if (q.x_before[2])
    return q.h_before ? moved<true, true>(q, reach, begin, end) : moved<true, false>(q, reach, begin, end);
  return q.h_before ? moved<false, true>(q, reach, begin, end) : moved<false, false>(q, reach, begin, end);
}

Index inside(const Real low[3], const Real high[3], const Real* const at[3], Index begin, Index end) {
  const Real *x = at[0], *y = at[1], *z = at[2];
  const Real x0 = low[0], y0 = low[1], z0 = low[2], x1 = high[0], y1 = high[1], z1 = high[2];
  Index count = 0;
#pragma omp simd reduction(+ : count)
  for (Index i = begin; i < end; ++i)
    count += (x[i] >= x0) & (x[i] <= x1) & (y[i] >= y0) & (y[i] <= y1) & (z[i] >= z0) & (z[i] <= z1);
  return count;
}

ParticleLoops::Bounds bounds(const ParticleLoops::Bodies& q, Real unit, Index begin, Index end) {
  constexpr Real infinity = __builtin_inf();
  ParticleLoops::Bounds out{{}, {}, infinity, -infinity, 0, false};
  int broken = 0;
  for (int d = 0; d < 3; ++d) {
    const Real* x = q.x[d];
    Real low = infinity, high = -infinity;
#pragma omp simd reduction(min : low) reduction(max : high) reduction(| : broken)
    for (Index i = begin; i < end; ++i) {
      const Real a = x[i];
      low = a < low ? a : low;
      high = high < a ? a : high;
      broken |= a - a == 0 ? 0 : 1;
    }
    out.low[d] = low, out.high[d] = high;
  }
  const Real *h = q.h, *m = q.m, *rho = q.rho;
  const Real whole = 6755399441055744.0 * unit;  // 1.5 x 2^52: sums with it have the resolution unit
  Real least = infinity, most = -infinity, volume = 0;
#pragma omp simd reduction(min : least) reduction(max : most) reduction(+ : volume) reduction(| : broken)
  for (Index i = begin; i < end; ++i) {
    const Real a = h[i];
    least = a < least ? a : least;
    most = most < a ? a : most;
    broken |= a - a == 0 ? 0 : 1;
    volume += (m[i] / rho[i] + whole) - whole;
  }
  out.h_min = least, out.h_max = most, out.volume = volume;
  out.broken = broken != 0;
  return out;
}

void compress(const Real* __restrict drhodt, Real dt, Real rho0, Real* __restrict rho, Real* __restrict mu,
              Real* __restrict half_dv, Index begin, Index end) {
  const Real inverse_rho0 = 1 / rho0, half_rho0 = 0.5 * rho0;
  for (Index i = begin; i < end; ++i) {
    const Real before = rho[i], after = before + drhodt[i] * dt;
    mu[i - begin] = after * inverse_rho0 - 1;
    half_dv[i - begin] = half_rho0 * (before - after) / (before * after);
    rho[i] = after;
  }
}

void load(const ParticleLoops::Law& law, Real* __restrict p, Real* __restrict E, Real* __restrict c,
          Index begin, Index end) {
  const Real *A = law.A, *dA = law.dA, *half_dv = law.half_dv;
  const Real inverse_rho0 = 1 / law.rho0, pc = law.pc;
#pragma omp simd
  for (Index i = begin; i < end; ++i) {
    const Real pressure = A[i - begin], after = pressure < pc ? pc : pressure,
               c2 = dA[i - begin] * inverse_rho0;
    E[i] -= half_dv[i - begin] * (p[i] + after);
    p[i] = after;
    c[i] = __builtin_sqrt(c2 < 0 ? 0 : c2);
  }
}

ParticleLoops::Range range(const Real* values, Index begin, Index end) {
  Real least = __builtin_inf(), most = -__builtin_inf();
  int broken = 0;
#pragma omp simd reduction(min : least) reduction(max : most) reduction(| : broken)
  for (Index i = begin; i < end; ++i) {
    const Real a = values[i];
    least = a < least ? a : least;
    most = most < a ? a : most;
    broken |= a == a ? 0 : 1;
  }
  return {least, most, broken != 0};
}

ParticleLoops::Range depths(const Real normal[3], const Real point[3], const Real* const at[3], Index begin,
                            Index end) {
  const Real *x = at[0], *y = at[1], *z = at[2];
  const Real nx = normal[0], ny = normal[1], nz = normal[2], px = point[0], py = point[1], pz = point[2];
  Real least = __builtin_inf(), most = -__builtin_inf();
  int broken = 0;
#pragma omp simd reduction(min : least) reduction(max : most) reduction(| : broken)
  for (Index i = begin; i < end; ++i) {
    const Real d = nx * (x[i] - px) + ny * (y[i] - py) + nz * (z[i] - pz);
    least = d < least ? d : least;
    most = most < d ? d : most;
    broken |= d == d ? 0 : 1;
  }
  return {least, most, broken != 0};
}

}  // namespace

ParticleLoops particle_loops() {
  return {&kick,   &drift,    &fastest2, &least_crossing, &moved, &inside,
          &bounds, &compress, &load,     &range,          &depths};
}

}  // namespace courant::COURANT_SIMD
