// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/drift_loops.hpp"

#include "sph/kernel.hpp"
#include "sph/pair_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

/// The cubic spline, its slope and how that changes at R, without the constant.
struct Spline {
  Pack a, b;
  COURANT_INLINE explicit Spline(const Pack& R) : a(max(2 - R, Pack::zero())), b(max(1 - R, Pack::zero())) {}
  COURANT_INLINE Pack shape() const { return 0.25 * (a * a * a) - b * b * b; }
  COURANT_INLINE Pack slope() const { return 3 * (b * b) - 0.75 * (a * a); }
  COURANT_INLINE Pack bend() const { return 1.5 * a - 6 * b; }
};

/// C / h^Dim
template <int Dim>
COURANT_INLINE Pack kernel_norm(const Pack& hinv) {
  return CubicSpline::C(Dim) * hinv * hinv * (Dim == 3 ? hinv : Pack::of(1));
}

template <int Dim>
COURANT_INLINE void store(const Sum<Dim>& sum, Real* const to[3], Index i, Index count, const Pack& factor) {
  (factor * sum.x).store(to[0] + i, count);
  (factor * sum.y).store(to[1] + i, count);
  if constexpr (Dim == 3) (factor * sum.z).store(to[2] + i, count);
}

/// v . (grad grad W) . u, but for the kernel's constant.
template <int Dim>
COURANT_INLINE Pack turn(const Spline& kernel, const Difference<Dim>& d, const Difference<Dim>& v,
                         const Difference<Dim>& u, const Pack& rinv, const Pack& hinv) {
  const Pack radial = dot(v, d) * dot(u, d) * (rinv * rinv);
  return kernel.bend() * hinv * radial + kernel.slope() * rinv * (dot(u, v) - radial);
}

/// What a drift u does to the density, see `drift_rate_loop`.
template <int Dim>
struct DriftRates {
  Pack middle = Pack::zero(), own = Pack::zero(), bend = Pack::zero();
  COURANT_INLINE void add(Real V, const Spline& kernel, const Difference<Dim>& d, const Difference<Dim>& v,
                          const Difference<Dim>& u, const Pack& rinv, const Pack& hinv) {
    middle += V * turn(kernel, d, v, u, rinv, hinv);
    bend += V * turn(kernel, d, u, u, rinv, hinv);
    own += V * (kernel.slope() * rinv) * dot(u, d);
  }
  COURANT_INLINE void store_all(const DriftArrays& a, Index i, Index count, const Pack& norm) const {
    const Pack factor = norm * Pack::load(a.rho + i, count), half = a.half_step * factor;
    (Pack::load(a.drhodt + i, count) - half * middle).store(a.drhodt + i, count);
    (factor * own - half * (middle + bend)).store(a.drift_rate + i, count);
  }
};

/// How the velocity changes over a way; v_i - v_j is added.
template <int Dim>
struct VelocityGradient {
  Sum<Dim> vx, vy, vz;
  COURANT_INLINE void add(const Pack& w, const Difference<Dim>& v, const Difference<Dim>& d) {
    vx.add(w * v.x, d);
    vy.add(w * v.y, d);
    if constexpr (Dim == 3) vz.add(w * v.z, d);
  }
  COURANT_INLINE void store_all(const DriftArrays& a, Index i, Index count, const Pack& factor) const {
    store(vx, a.velocity_gradient[0], i, count, factor);
    store(vy, a.velocity_gradient[1], i, count, factor);
    if constexpr (Dim == 3) store(vz, a.velocity_gradient[2], i, count, factor);
  }
};

template <int Dim, bool Correct>
void shifting(const DriftArrays& a, const NeighbourLists& lists) {
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Places<Dim> xi(a.x, i, count);
    const Pack hi = Pack::load(a.h + i, count), hinv = 1 / hi, tiny = tiny_distance2 * hi * hi;
    const Pack at_spacing = Pack::load(a.at_spacing + i, count), spread_i = Pack::load(a.spread + i, count);
    const Places<Dim> vi(a.v, i, count), ui(a.drifted, i, count);
    Sum<Dim> gradient, normal;
    VelocityGradient<Dim> turning;
    DriftRates<Dim> rates;
    Pack spread = Pack::zero(), filling = Pack::zero();
    Pack edge = max(a.surface - spread_i, Pack::zero());
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2);
      const Spline kernel(r2 * rinv * hinv);
      const Pack shape = kernel.shape(), w = kernel.slope() * rinv * a.V[j];
      const Pack ratio = shape * at_spacing, ratio2 = ratio * ratio;
      gradient.add(w * (1 + a.pairing * (ratio2 * ratio2)), d);
      normal.add(w * (a.spread[j] - spread_i), d);
      spread += w * r2;
      filling += shape * a.V[j];
      const Real open = a.surface - a.spread[j];
      if (open > 0) edge += open * kernel.a;
      const Difference<Dim> v(vi, a.v, j), u(ui, a.drifted, j);
      rates.add(a.V[j], kernel, d, v, u, rinv, hinv);
      if constexpr (Correct) turning.add(w, v, d);
    }
    const Pack norm = kernel_norm<Dim>(hinv), slope_norm = norm * hinv;
    store(gradient, a.gradient, i, count, slope_norm);
    store(normal, a.normal, i, count, slope_norm);
    (0 - slope_norm * spread).store(a.new_spread + i, count);
    (norm * filling).store(a.filling + i, count);
    edge.store(a.edge + i, count);
    rates.store_all(a, i, count, slope_norm);
    if constexpr (Correct) turning.store_all(a, i, count, 0 - slope_norm);
  }
}

template <int Dim, bool UniformH>
void xsph(const DriftArrays& a, const NeighbourLists& lists) {
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Places<Dim> xi(a.x, i, count), vi(a.v, i, count);
    const Pack hi = Pack::load(a.h + i, count), hinv = 1 / hi, tiny = tiny_distance2 * hi * hi;
    const Pack mi = Pack::load(a.m + i, count), Vi = Pack::load(a.V + i, count);
    const Pack norm = kernel_norm<Dim>(hinv);
    Sum<Dim> sum;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), u(vi, a.v, j);
      const Pack r2 = dot(d, d) + tiny, r = r2 * rsqrt(r2);
      Pack w = Spline(r * hinv).shape();
      if constexpr (!UniformH) {
        const Real hj = 1 / a.h[j];
        w = 0.5 * (w + Spline(r * hj).shape() * (CubicSpline::C(Dim) * power<Dim>(hj)) / norm);
      }
      // m_j / mean of m_i/V_i and m_j/V_j
      sum.add(w * (2 * a.m[j] * a.V[j]) * Vi / (mi * a.V[j] + Vi * a.m[j]), u);
    }
    store(sum, a.drift, i, count, 0 - norm);
  }
}

template <int Dim>
void drift_rate(const DriftArrays& a, const NeighbourLists& lists) {
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Places<Dim> xi(a.x, i, count), vi(a.v, i, count), ui(a.drifted, i, count);
    const Pack hi = Pack::load(a.h + i, count), hinv = 1 / hi, tiny = tiny_distance2 * hi * hi;
    DriftRates<Dim> rates;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), v(vi, a.v, j), u(ui, a.drifted, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2);
      const Spline kernel(r2 * rinv * hinv);
      rates.add(a.V[j], kernel, d, v, u, rinv, hinv);
    }
    rates.store_all(a, i, count, kernel_norm<Dim>(hinv) * hinv);
  }
}

}  // namespace

DriftLoop shifting_loop(int dim, bool correct) {
  if (dim == 2) return correct ? &shifting<2, true> : &shifting<2, false>;
  return correct ? &shifting<3, true> : &shifting<3, false>;
}
DriftLoop drift_rate_loop(int dim) {
  return dim == 2 ? &drift_rate<2> : &drift_rate<3>;
}
DriftLoop xsph_loop(int dim, bool uniform_h) {
  if (dim == 2) return uniform_h ? &xsph<2, true> : &xsph<2, false>;
  return uniform_h ? &xsph<3, true> : &xsph<3, false>;
}

}  // namespace courant::COURANT_SIMD
