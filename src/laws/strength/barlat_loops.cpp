// Compiled once for each instruction set; see docs/architecture.md. Nothing here may be shared with other
// files. Loops without branches, so that they go through registers of several points.
#include <cmath>

#include "base/elementary.hpp"
#include "base/simd.hpp"
#include "laws/strength/barlat.hpp"

namespace courant::COURANT_SIMD {

namespace {

constexpr Real none = 1e-150;

void go(const std::array<Real, 3>& elastic, const PointBlock& block, BarlatPoints& p) {
  const Real along = elastic[0] * block.dt, across = elastic[1] * block.dt, twice = 2 * elastic[2] * block.dt;
  const Real *da = block.rate[0], *db = block.rate[1], *dab = block.rate[3], *dbc = block.rate[4],
             *dca = block.rate[5];
  Real *sa = block.stress[0], *sb = block.stress[1], *sab = block.stress[3], *sbc = block.stress[4],
       *sca = block.stress[5];
  const Real* plastic = block.history[0];
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    p.before_a[i] = sa[i], p.before_b[i] = sb[i], p.a[i] = p.b[i] = 0;
    p.before[i] = p.at.plastic[i] = plastic[i];
    sa[i] += along * da[i] + across * db[i], sb[i] += across * da[i] + along * db[i];
    sab[i] += twice * dab[i], sbc[i] += twice * dbc[i], sca[i] += twice * dca[i];
    p.trial_a[i] = sa[i], p.trial_b[i] = sb[i], p.trial_ab[i] = sab[i];
  }
}

/// |x|^(M - 2); N: M where it is known to the compiler, else 0.
template <int N>
COURANT_INLINE Real power_less_2(Real x, Real M) {
  const Real square = x * x;
  if constexpr (N == 2) return 1;
  if constexpr (N == 6) return square * square;
  if constexpr (N == 8) return square * square * square;
  return to_power(std::sqrt(square) + none, M - 2);
}

/// F = (q/Y)^M at these stresses over Y, its slopes over M, and the stress that a plastic strain along them
/// takes away.
struct AtPoint {
  Real F, na, nb, nc, ca, cb, cc;
};
template <int N, bool one>
COURANT_INLINE AtPoint at_point(const SheetSurface& s, const std::array<Real, 3>& elastic, Real a, Real b,
                                Real c) {
  AtPoint out;
  const Real K1 = s.k[0] * a + s.k[1] * b, d = s.d[0] * a + s.d[1] * b;
  const Real K2 = std::sqrt(d * d + s.t * s.t * c * c) + none;
  const Real e = one ? d : s.e[0] * a + s.e[1] * b;
  const Real K3 = one ? K2 : std::sqrt(e * e + s.u * s.u * c * c) + none;
  const Real plus = K1 + K2, minus = K1 - K2, twice = 2 * K3;
  const Real of_plus = s.A * plus * power_less_2<N>(plus, s.M),
             of_minus = s.A * minus * power_less_2<N>(minus, s.M),
             of_twice = s.C * twice * power_less_2<N>(twice, s.M);
  out.F = 0.5 * (of_plus * plus + of_minus * minus + of_twice * twice);
  const Real by_K1 = 0.5 * (of_plus + of_minus);
  if constexpr (one) {
    const Real by_K2 = (0.5 * (of_plus - of_minus) + of_twice) / K2;
    out.na = s.k[0] * by_K1 + s.d[0] * d * by_K2, out.nb = s.k[1] * by_K1 + s.d[1] * d * by_K2;
    out.nc = by_K2 * s.t * s.t * c;
  } else {
    const Real by_K2 = 0.5 * (of_plus - of_minus) / K2, by_K3 = of_twice / K3;
    out.na = s.k[0] * by_K1 + s.d[0] * d * by_K2 + s.e[0] * e * by_K3;
    out.nb = s.k[1] * by_K1 + s.d[1] * d * by_K2 + s.e[1] * e * by_K3;
    out.nc = (by_K2 * s.t * s.t + by_K3 * s.u * s.u) * c;
  }
  out.ca = elastic[0] * out.na + elastic[1] * out.nb, out.cb = elastic[1] * out.na + elastic[0] * out.nb;
  out.cc = elastic[2] * out.nc;
  return out;
}

/// F^(1/M) of F near 1.
COURANT_INLINE Real root_near_1(Real F, Real per_M) {
  const Real d = F - 1;
  return 1 + per_M * d * (1 - 0.5 * (1 - per_M) * d * (1 - (2 - per_M) / 3 * d));
}

// Newton's method for q along the normal of the surface at the present point, which comes to a convex surface
// from without: q/Y - e (n C n/Y + H q/Y^2) = 1 with the normal n; `far` from it by roots, each for its own
// points.
template <int N, bool one, bool far>
bool approach_by(const SheetSurface& s, const std::array<Real, 3>& elastic, const PointBlock& block,
                 BarlatPoints& p) {
  constexpr Real round_off = 1e-15, close = 1e-9, far_from = 1.1;
  Real *sa = block.stress[0], *sb = block.stress[1], *sab = block.stress[3], *plastic = p.at.plastic;
  const Real per_M = 1 / s.M;
  Real left = 0, most = 0;
#pragma omp simd reduction(max : left, most)
  for (Index i = 0; i < block.count; ++i) {
    const Real per_Y = 1 / (p.at.stress[i] > none ? p.at.stress[i] : none);
    const AtPoint n = at_point<N, one>(s, elastic, sa[i] * per_Y, sb[i] * per_Y, sab[i] * per_Y);
    const Real q = far ? to_power(n.F, per_M) : root_near_1(n.F, per_M), over = q - 1, to_normal = q / n.F;
    const Real stiffness = (n.na * n.ca + n.nb * n.cb + n.nc * n.cc) * per_Y * to_normal * to_normal;
    // a bend of the yield stress may lead below the surface
    const bool within = far ? n.F > far_from : n.F <= far_from;
    const bool open = within && (over > round_off || (over < -round_off && plastic[i] > p.before[i]));
    const Real newton = over / (stiffness + p.at.by_strain[i] * per_Y * q), e = open ? newton : 0,
               x = open ? newton * to_normal : 0;
    const Real size = over > 0 ? over : -over, rest = open && size > close ? 1 : 0;
    left = rest > left ? rest : left, most = n.F > most ? n.F : most;
    sa[i] -= x * n.ca, sb[i] -= x * n.cb, sab[i] -= x * n.cc;
    p.a[i] += x * n.na, p.b[i] += x * n.nb, plastic[i] += e;
  }
  if constexpr (!far)
    if (most > far_from) approach_by<N, one, true>(s, elastic, block, p);
  return left > 0 || most > far_from;
}

// Flow along the normal at the end of the step: n (trial - e C n) = Y(e) with the normal at the present
// point, of which q = n s. Only of steps within which the normal changes little.
template <int N, bool one>
void turn_by(const SheetSurface& s, const std::array<Real, 3>& elastic, const PointBlock& block,
             BarlatPoints& p) {
  constexpr Real little = 0.5;
  Real *sa = block.stress[0], *sb = block.stress[1], *sab = block.stress[3], *plastic = p.at.plastic;
  const Real per_M = 1 / s.M;
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real Y = p.at.stress[i] > none ? p.at.stress[i] : none, per_Y = 1 / Y;
    const AtPoint n = at_point<N, one>(s, elastic, sa[i] * per_Y, sb[i] * per_Y, sab[i] * per_Y);
    const Real to_normal = root_near_1(n.F, per_M) / n.F;
    const Real stiffness = (n.na * n.ca + n.nb * n.cb + n.nc * n.cc) * to_normal * to_normal;
    const Real along = (n.na * p.trial_a[i] + n.nb * p.trial_b[i] + n.nc * p.trial_ab[i]) * to_normal;
    const Real flown = plastic[i] - p.before[i], H = p.at.by_strain[i];
    const Real e = (along - Y + H * flown) / (stiffness + H), x = e * to_normal;
    const bool turns = flown > 0 && e > 0 && flown * stiffness < little * Y;
    sa[i] = turns ? p.trial_a[i] - x * n.ca : sa[i];
    sb[i] = turns ? p.trial_b[i] - x * n.cb : sb[i];
    sab[i] = turns ? p.trial_ab[i] - x * n.cc : sab[i];
    p.a[i] = turns ? x * n.na : p.a[i], p.b[i] = turns ? x * n.nb : p.b[i];
    plastic[i] = turns ? p.before[i] + e : plastic[i];
  }
}

template <int N, bool one>
bool step_by(bool turning, const SheetSurface& s, const std::array<Real, 3>& elastic, const PointBlock& block,
             BarlatPoints& p) {
  if (!turning) return approach_by<N, one, false>(s, elastic, block, p);
  turn_by<N, one>(s, elastic, block, p);
  return true;
}

template <bool one>
bool step_of(bool turning, const SheetSurface& surface, const std::array<Real, 3>& elastic,
             const PointBlock& block, BarlatPoints& points) {
  if (surface.M == 2) return step_by<2, one>(turning, surface, elastic, block, points);
  if (surface.M == 6) return step_by<6, one>(turning, surface, elastic, block, points);
  if (surface.M == 8) return step_by<8, one>(turning, surface, elastic, block, points);
  return step_by<0, one>(turning, surface, elastic, block, points);
}

bool step(bool turning, const SheetSurface& surface, const std::array<Real, 3>& elastic,
          const PointBlock& block, BarlatPoints& points) {
  return surface.one ? step_of<true>(turning, surface, elastic, block, points)
                     : step_of<false>(turning, surface, elastic, block, points);
}

void settle(Real by_plane, const PointBlock& block, const BarlatPoints& p, Real* rate_zz) {
  const Real per_dt = 1 / block.dt;
  Real *sa = block.stress[0], *sb = block.stress[1], *sc = block.stress[2], *plastic = block.history[0];
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real elastic = by_plane * (sa[i] - p.before_a[i] + sb[i] - p.before_b[i]);
    rate_zz[i] = (elastic - p.a[i] - p.b[i]) * per_dt;
    plastic[i] = p.at.plastic[i], sc[i] = 0;
  }
}

}  // namespace

BarlatLoops barlat_loops() {
  return {&go, &step, &settle};
}

}  // namespace courant::COURANT_SIMD
