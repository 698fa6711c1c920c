// Compiled once for each instruction set; see docs/architecture.md. Nothing here may be shared with other
// files. Loops without branches, so that they go through registers of several points.
#include <algorithm>

#include "base/elementary.hpp"
#include "laws/strength/rate_factor.hpp"

namespace courant::COURANT_SIMD {

namespace {

/// Without a rate there is no influence of it.
bool leave_still(YieldPoints& points) {
  if (points.still) std::fill_n(points.by_rate, points.count, 0.0);
  return points.still;
}

void scale(const CowperSymonds& by, YieldPoints& points) {
  if (leave_still(points)) return;
  const Real per_C = 1 / by.C, per_P = 1 / by.P, P = by.P;
#pragma omp simd
  for (Index i = 0; i < points.count; ++i) {
    const Real rate = points.rate[i];
    const Real slope = per_P * per_C * to_power(rate * per_C, per_P - 1), factor = 1 + slope * rate * P;
    points.by_rate[i] = points.stress[i] * slope;
    points.stress[i] *= factor, points.by_strain[i] *= factor;
  }
}

void add(const CowperSymonds& by, Real stress, YieldPoints& points) {
  if (leave_still(points)) return;
  const Real per_C = 1 / by.C, per_P = 1 / by.P, P = by.P;
#pragma omp simd
  for (Index i = 0; i < points.count; ++i) {
    const Real rate = points.rate[i];
    const Real slope = stress * per_P * per_C * to_power(rate * per_C, per_P - 1);
    points.by_rate[i] = slope, points.stress[i] += slope * rate * P;
  }
}

void power_law(Real K, Real e0, Real N, YieldPoints& points) {
#pragma omp simd
  for (Index i = 0; i < points.count; ++i) {
    const Real e = e0 + points.plastic[i], per_e = K * to_power(e, N - 1);
    points.stress[i] = per_e * e, points.by_strain[i] = N * per_e;
  }
}

void power_hardening(const PowerHardening& of, YieldPoints& points) {
  const Real A = of.A, B = of.B, n = of.n, most = of.most;
  if (B == 0 || n == 0 || n == 1) {
    const Real slope = n == 1 ? B : 0, first = n == 0 ? A + B : A;
#pragma omp simd
    for (Index i = 0; i < points.count; ++i) {
      const Real stress = first + slope * points.plastic[i];
      points.stress[i] = stress < most ? stress : most, points.by_strain[i] = stress < most ? slope : 0;
    }
    return;
  }
#pragma omp simd
  for (Index i = 0; i < points.count; ++i) {
    const Real e = points.plastic[i], per_e = B * to_power(e, n - 1), stress = A + per_e * e;
    points.stress[i] = stress < most ? stress : most, points.by_strain[i] = stress < most ? n * per_e : 0;
  }
}

void logarithmic(Real rate0, Real C, Real C2, YieldPoints& points) {
  if (leave_still(points)) return;
  const Real per_rate0 = 1 / rate0;
#pragma omp simd
  for (Index i = 0; i < points.count; ++i) {
    const Real x = points.rate[i] * per_rate0;
    const bool counts = x > 1;
    const Real held = counts ? x : 1, logarithm = natural_logarithm(held);
    const Real factor = 1 + logarithm * (C + C2 * logarithm);
    points.by_rate[i] = counts ? points.stress[i] * (C + 2 * C2 * logarithm) * per_rate0 / held : 0;
    points.stress[i] *= factor, points.by_strain[i] *= factor;
  }
}

void power_of_rate(Real rate0, Real C, YieldPoints& points) {
  if (leave_still(points)) return;
  const Real per_rate0 = 1 / rate0;
#pragma omp simd
  for (Index i = 0; i < points.count; ++i) {
    const Real x = points.rate[i] * per_rate0;
    const bool counts = x > 1;
    const Real held = counts ? x : 1, factor = to_power(held, C);
    points.by_rate[i] = counts ? points.stress[i] * C * factor * per_rate0 / held : 0;
    points.stress[i] *= factor, points.by_strain[i] *= factor;
  }
}

void power_above_1(Real rate0, Real C, YieldPoints& points) {
  if (leave_still(points)) return;
  const Real per_rate0 = 1 / rate0;
#pragma omp simd
  for (Index i = 0; i < points.count; ++i) {
    const Real x = 1 + points.rate[i] * per_rate0, factor = to_power(x, C);
    points.by_rate[i] = points.stress[i] * C * factor * per_rate0 / x;
    points.stress[i] *= factor, points.by_strain[i] *= factor;
  }
}

void voce(Real Q, Real C, YieldPoints& points) {
#pragma omp simd
  for (Index i = 0; i < points.count; ++i) {
    const Real left = exponential(-C * points.plastic[i]);
    points.stress[i] += Q * (1 - left), points.by_strain[i] += Q * C * left;
  }
}

void logarithm(Index count, const Real* rate, Real* out) {
  constexpr Real least = 1e-300;
#pragma omp simd
  for (Index i = 0; i < count; ++i) out[i] = natural_logarithm(rate[i] < least ? least : rate[i]);
}

void limit(Real most, const Real* factor, YieldPoints& points) {
#pragma omp simd
  for (Index i = 0; i < points.count; ++i) {
    const bool below = points.stress[i] < most;
    points.by_rate[i] = below ? points.by_rate[i] : 0;
    points.by_strain[i] = below ? points.by_strain[i] : 0;
    points.stress[i] = below ? points.stress[i] : most;
  }
  if (!factor) return;
#pragma omp simd
  for (Index i = 0; i < points.count; ++i)
    points.by_rate[i] *= factor[i], points.by_strain[i] *= factor[i], points.stress[i] *= factor[i];
}

}  // namespace

RateLoops rate_loops() {
  return {&scale,         &add,           &power_law, &power_hardening, &logarithmic,
          &power_of_rate, &power_above_1, &voce,      &logarithm,       &limit};
}

}  // namespace courant::COURANT_SIMD
