// Compiled once for each instruction set; see docs/architecture.md. Nothing here may be shared with other
// files. Loops without branches, so that they go through registers of several points.
#include <cmath>

#include "base/simd.hpp"
#include "laws/strength/yield_return.hpp"

namespace courant::COURANT_SIMD {

namespace {

constexpr Real none = 1e-300, small = 1e-3;

/// Of rates of flow and their slopes over x those with the part of volume, `v` = tr(D), whose slope is `dv`.
COURANT_INLINE void add_volume(Real v, Real dv, Real& rate, Real& faster) {
  const Real flow = rate, square = flow * flow, most = 0.5 * square, part = 2.0 / 9 * v * v;
  const bool free = part < most;
  const Real both = std::sqrt(square + (free ? part : most)), at_cap = 1.224744871391589;  // sqrt(3/2)
  faster = free ? (flow * faster + 2.0 / 9 * v * dv) / (both > none ? both : none) : at_cap * faster;
  rate = both;
}

void go(const ReturnLaw& law, const PointBlock& block, ReturnPoints& r) {
  const Real stiffness = 3 * law.G + law.kinematic, dt = block.dt;
  const Real *dxx = block.rate[0], *dyy = block.rate[1], *dzz = block.rate[2], *dxy = block.rate[3],
             *dyz = block.rate[4], *dzx = block.rate[5];
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real volume = dxx[i] + dyy[i] + dzz[i], mean = volume / 3;
    const Real a = dxx[i] - mean, b = dyy[i] - mean, c = dzz[i] - mean;
    const Real rate = std::sqrt(2.0 / 3 * (a * a + b * b + c * c) +
                                4.0 / 3 * (dxy[i] * dxy[i] + dyz[i] * dyz[i] + dzx[i] * dzx[i]));
    r.x[i] = r.low[i] = r.excess[i] = 0, r.high[i] = r.trial_q[i] / stiffness;
    r.least[i] = small * r.trial_q[i] + none;
    r.first[i] = rate * dt, r.volume[i] = volume;
  }
}

void measure(const ReturnLaw& law, Real dt, const Real* before, ReturnPoints& r) {
  const Real stiffness = 3 * law.G + law.kinematic, per_dt = 1 / dt;
#pragma omp simd
  for (Index i = 0; i < r.at.count; ++i) {
    r.q[i] = r.trial_q[i] - stiffness * r.x[i];
    r.fall[i] = stiffness, r.grow[i] = 1;
    r.at.plastic[i] = before[i] + r.x[i];
  }
  if (law.rate == YieldRate::none) return;
#pragma omp simd
  for (Index i = 0; i < r.at.count; ++i) r.at.rate[i] = r.x[i] * per_dt, r.faster[i] = per_dt;
  if (law.rate != YieldRate::of_flow_and_volume) return;
#pragma omp simd
  for (Index i = 0; i < r.at.count; ++i) add_volume(r.volume[i], 0, r.at.rate[i], r.faster[i]);
}

template <bool moves>
void go_in_plane(const ReturnLaw& law, const PointBlock& block, Real* const* alpha, Real* sum_before,
                 ReturnPoints& r) {
  const Real across = law.lambda / (law.lambda + 2 * law.G), twice = 2 * law.G * block.dt;
  const Real common = law.lambda * (1 - across) * block.dt, far = 1e12 / (2 * law.G);
  const Real *dxx = block.rate[0], *dyy = block.rate[1], *dxy = block.rate[3], *dyz = block.rate[4],
             *dzx = block.rate[5];
  Real *xx = block.stress[0], *yy = block.stress[1], *xy = block.stress[3], *yz = block.stress[4],
       *zx = block.stress[5];
  const Real *axx = moves ? alpha[0] : xx, *ayy = moves ? alpha[1] : xx, *axy = moves ? alpha[3] : xx,
             *ayz = moves ? alpha[4] : xx, *azx = moves ? alpha[5] : xx;
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real trace = common * (dxx[i] + dyy[i]);
    sum_before[i] = xx[i] + yy[i];
    xx[i] += trace + twice * dxx[i], yy[i] += trace + twice * dyy[i];
    xy[i] += twice * dxy[i], yz[i] += twice * dyz[i], zx[i] += twice * dzx[i];
    // the back stress in the plane that has this deviator
    const Real bxx = moves ? 2 * axx[i] + ayy[i] : 0, byy = moves ? 2 * ayy[i] + axx[i] : 0;
    const Real exy = moves ? xy[i] - axy[i] : xy[i], eyz = moves ? yz[i] - ayz[i] : yz[i],
               ezx = moves ? zx[i] - azx[i] : zx[i];
    const Real sum = xx[i] + yy[i] - (bxx + byy), difference = xx[i] - yy[i] - (bxx - byy);
    r.sum[i] = sum;
    r.P[i] = 0.25 * sum * sum;
    r.S[i] = 0.75 * difference * difference + 3 * (exy * exy + eyz * eyz + ezx * ezx);
    r.x[i] = r.low[i] = r.excess[i] = 0, r.high[i] = far;
    r.least[i] = small * std::sqrt(r.P[i] + r.S[i]) + none;
  }
  if (law.rate == YieldRate::none) return;
  const Real dt = block.dt;
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real sum = dxx[i] + dyy[i];
    r.volume[i] = (1 - across) * sum;
    // m where all strain is plastic, without change of volume
    const Real square = 2.0 / 3 * (dxx[i] * dxx[i] + dyy[i] * dyy[i] + sum * sum) +
                        4.0 / 3 * (dxy[i] * dxy[i] + dyz[i] * dyz[i] + dzx[i] * dzx[i]);
    const Real q = std::sqrt(r.P[i] + r.S[i]);
    r.first[i] = 1.5 * dt * std::sqrt(square) / (q > none ? q : none);
  }
}

void go_in_any_plane(const ReturnLaw& law, const PointBlock& block, Real* const* alpha, Real* sum,
                     ReturnPoints& r) {
  alpha ? go_in_plane<true>(law, block, alpha, sum, r) : go_in_plane<false>(law, block, alpha, sum, r);
}

void measure_in_plane(const ReturnLaw& law, Real dt, const Real* before, ReturnPoints& r) {
  const Real of_f = law.of_f(), of_g = law.of_g();
  const Index count = r.at.count;
#pragma omp simd
  for (Index i = 0; i < count; ++i) {
    // one division for both: it takes as long as ten other operations
    const Real per_f = 1 + of_f * r.x[i], per_g = 1 + of_g * r.x[i], both = 1 / (per_f * per_g);
    const Real f = per_g * both, g = per_f * both;
    const Real p = r.P[i] * f * f, s = r.S[i] * g * g, q = std::sqrt(p + s);
    const Real per_q = 1 / (q > none ? q : none), fall = (p * f * of_f + s * g * of_g) * per_q;
    r.q[i] = q, r.fall[i] = fall, r.per_q[i] = per_q;
    r.at.plastic[i] = before[i] + 2.0 / 3 * r.x[i] * q;
    r.grow[i] = 2.0 / 3 * (q - r.x[i] * fall);
  }
  if (law.rate == YieldRate::none) return;
  const Real per_dt = 1 / dt;
#pragma omp simd
  for (Index i = 0; i < count; ++i)
    r.at.rate[i] = 2.0 / 3 * per_dt * r.x[i] * r.q[i], r.faster[i] = per_dt * r.grow[i];
  if (law.rate != YieldRate::of_flow_and_volume) return;
  const Real per_x = law.elastic_f() / ((3 * law.lambda + 2 * law.G) * dt);
#pragma omp simd
  for (Index i = 0; i < count; ++i) {
    const Real f = 1 / (1 + of_f * r.x[i]), slope = -per_x * f * r.sum[i];
    add_volume(r.volume[i] + r.x[i] * slope, slope * f, r.at.rate[i], r.faster[i]);
  }
}

/// The next x of a point: Newton's method, or where that leads out of the bounds a step between them. In the
/// plane with q as q(x)/(1 + c (x' - x)), which it is where the stress keeps its direction.
template <bool plane, bool steep, bool of_rate>
COURANT_INLINE Real next_x(const ReturnPoints& r, Index i, Real over, Real low, Real high) {
  const Real x = r.x[i], yield = r.at.stress[i];
  Real fall = r.fall[i], rise = r.at.by_strain[i] * r.grow[i], middle = 0.5 * (low + high);
  if (plane) fall *= yield * r.per_q[i];
  Real slope = fall + rise, newton;
  if constexpr (!steep && !of_rate) {
    newton = x + over / (slope > none ? slope : none);
  } else {
    // the rate zz may lower the rate of all strain, and with it the yield stress, at first
    const Real still = slope, least = 0.05 * slope;
    if (of_rate) slope += r.at.by_rate[i] * r.faster[i];
    slope = slope > least ? slope : 0.5 * still;
    slope = slope > none ? slope : none;
    // a slope that is not above any before the root; the chord from the lower bound
    const Real softer = rise > 0 ? fall : (still > none ? still : none);
    const Real divisor = over > 0 ? softer : r.excess[i] - over, at = x > 0 ? x : 1;
    // one division for all three: it takes as long as ten other operations
    const Real all = 1 / (slope * divisor * at), per_slope = all * divisor * at;
    const Real step = over * per_slope, part = all * slope * at, per_x = all * slope * divisor;
    newton = x + step;
    Real share = r.excess[i] * part;
    if (steep) {
      const Real root = 1 + 0.25 * step * per_x, square = root * root;
      const Real fourth = root > 0 ? x * square * square : -1;
      newton = x > 0 ? fourth : newton;
      // not beyond where the stress alone would be low enough
      const Real most = x + over * part;
      newton = over > 0 && newton > most ? most : newton;
      const Real square_of_share = share * share;
      share = low > 0 ? share : square_of_share * square_of_share;
    }
    middle = over > 0 ? middle : low + (x - low) * share;
  }
  const Real within = newton >= low && newton <= high ? newton : middle;
  return yield > 0 ? within : high;  // softening has left no strength
}

template <bool plane, bool steep, bool of_rate>
bool approach(bool smooth, int round, ReturnPoints& r) {
  constexpr Real round_off = 1e-15;
  // before the last step, which squares it where yield stresses have no bend; 3e-4 leaves 4e-7 with a fifth
  // root of the rate
  const Real close = !smooth ? 1e-9 : of_rate ? 3e-4 : 1e-7;
  constexpr Real near = 1e-6;
  // beyond, every second step halves the interval, whatever the yield stress is like
  constexpr int quick = 12;
  const Real halved = round > quick && round % 2 == 0 ? (close > near ? close : near) : 1 / none;
  Real most = 0;
#pragma omp simd reduction(max : most)
  for (Index i = 0; i < r.at.count; ++i) {
    const Real yield = r.at.stress[i], over = r.q[i] - yield, size = over > 0 ? over : -over;
    const Real low = over > 0 ? r.x[i] : r.low[i], high = over > 0 ? r.high[i] : r.x[i];
    if (steep || of_rate) r.excess[i] = over > 0 ? over : r.excess[i];
    const Real scale = yield + r.least[i];
    Real next = next_x<plane, steep, of_rate>(r, i, over, low, high);
    if (steep || of_rate) next = size > halved * scale ? 0.5 * (low + high) : next;
    const bool open = high > low && size > round_off * scale;
    r.low[i] = low, r.high[i] = high;
    r.x[i] = open ? next : r.x[i];
    const Real left = open && size > close * scale ? 1 : 0;
    most = left > most ? left : most;
  }
  return most > 0;
}

/// From x = 0, where no rate counts, to the x of a rate of all strain, which is near where the rate counts
/// much.
template <bool plane>
bool start(ReturnPoints& r) {
  constexpr Real part = 1e-6;
  Real any = 0;
#pragma omp simd reduction(max : any)
  for (Index i = 0; i < r.at.count; ++i) {
    const Real yield = r.at.stress[i], over = r.q[i] - yield, rise = r.at.by_strain[i] * r.grow[i];
    const bool yields = over > 0;
    const Real fall = plane ? r.fall[i] * yield * r.per_q[i] : r.fall[i];
    const Real slope = fall + rise > none ? fall + rise : none, newton = over / slope;
    const Real most = newton < r.high[i] ? newton : r.high[i], least = part * most;
    const Real held = r.first[i] < most ? r.first[i] : most, x = held > least ? held : least;
    r.excess[i] = yields ? over : 0;
    r.high[i] = yields ? r.high[i] : 0;
    r.x[i] = yields ? x : 0;
    any = yields ? 1 : any;
  }
  return any > 0;
}

template <bool plane>
bool approach_any(const ReturnLaw& law, int round, ReturnPoints& r) {
  if (law.rate == YieldRate::none)
    return law.steep ? approach<plane, true, false>(law.smooth, round, r)
                     : approach<plane, false, false>(true, round, r);
  return round == 0 ? start<plane>(r) : approach<plane, true, true>(law.smooth, round, r);
}

template <bool moves>
void settle(const ReturnLaw& law, const PointBlock& block, Real* const* alpha, Real* rate_zz,
            const ReturnPoints& r) {
  const Real bulk = 1 / ((3 * law.lambda + 2 * law.G) * block.dt), of_f = law.of_f(), of_g = law.of_g();
  const Real forth = 2.0 / 3 * law.kinematic;
  const Real *dxx = block.rate[0], *dyy = block.rate[1];
  Real *xx = block.stress[0], *yy = block.stress[1], *xy = block.stress[3], *yz = block.stress[4],
       *zx = block.stress[5], *plastic = block.history[0];
  Real *axx = moves ? alpha[0] : xx, *ayy = moves ? alpha[1] : xx, *azz = moves ? alpha[2] : xx,
       *axy = moves ? alpha[3] : xx, *ayz = moves ? alpha[4] : xx, *azx = moves ? alpha[5] : xx;
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real f = 1 / (1 + of_f * r.x[i]), g = 1 / (1 + of_g * r.x[i]);
    plastic[i] += 2.0 / 3 * r.x[i] * std::sqrt(r.P[i] * f * f + r.S[i] * g * g);
    if constexpr (moves) {
      const Real bxx = 2 * axx[i] + ayy[i], byy = 2 * ayy[i] + axx[i];
      const Real sum = f * (xx[i] + yy[i] - (bxx + byy)), difference = g * (xx[i] - yy[i] - (bxx - byy));
      const Real exx = 0.5 * (sum + difference), eyy = 0.5 * (sum - difference);
      const Real exy = g * (xy[i] - axy[i]), eyz = g * (yz[i] - ayz[i]), ezx = g * (zx[i] - azx[i]);
      const Real share = forth * r.x[i], mean = sum / 3;
      axx[i] += share * (exx - mean), ayy[i] += share * (eyy - mean), azz[i] -= share * mean;
      axy[i] += share * exy, ayz[i] += share * eyz, azx[i] += share * ezx;
      xx[i] = exx + 2 * axx[i] + ayy[i], yy[i] = eyy + 2 * ayy[i] + axx[i];
      xy[i] = exy + axy[i], yz[i] = eyz + ayz[i], zx[i] = ezx + azx[i];
    } else {
      const Real sum = f * (xx[i] + yy[i]), difference = g * (xx[i] - yy[i]);
      xx[i] = 0.5 * (sum + difference), yy[i] = 0.5 * (sum - difference);
      xy[i] *= g, yz[i] *= g, zx[i] *= g;
    }
    // the volume changes elastically
    rate_zz[i] = (xx[i] + yy[i] - rate_zz[i]) * bulk - dxx[i] - dyy[i];
  }
}

void settle_any(const ReturnLaw& law, const PointBlock& block, Real* const* alpha, Real* rate_zz,
                const ReturnPoints& r) {
  alpha ? settle<true>(law, block, alpha, rate_zz, r) : settle<false>(law, block, alpha, rate_zz, r);
}

}  // namespace

ReturnLoops return_loops() {
  return {
      &go,        &measure, &approach_any<false>, &go_in_any_plane, &measure_in_plane, &approach_any<true>,
      &settle_any};
}

}  // namespace courant::COURANT_SIMD
