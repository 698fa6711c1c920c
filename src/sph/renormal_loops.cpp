// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/renormal_loops.hpp"

#include "sph/pair_sums.hpp"

namespace courant::COURANT_SIMD {

namespace {

/// Symmetric part of a sum of dyads.
template <int Dim>
struct Dyads {
  Pack xx = Pack::zero(), yy = xx, zz = xx, xy = xx, yz = xx, zx = xx;
  COURANT_INLINE void add(const Difference<Dim>& a, const Difference<Dim>& b) {
    xx += a.x * b.x;
    yy += a.y * b.y;
    xy += a.x * b.y + a.y * b.x;
    if constexpr (Dim == 3) {
      zz += a.z * b.z;
      yz += a.y * b.z + a.z * b.y;
      zx += a.z * b.x + a.x * b.z;
    }
  }
  COURANT_INLINE void store(Real* const to[6], Index i, Index count, Real factor) const {
    const Real half = 0.5 * factor;
    (factor * xx).store(to[0] + i, count);
    (factor * yy).store(to[1] + i, count);
    (factor * zz).store(to[2] + i, count);
    (half * xy).store(to[3] + i, count);
    (half * yz).store(to[4] + i, count);
    (half * zx).store(to[5] + i, count);
  }
};

template <int Dim>
COURANT_INLINE Difference<Dim> times(const Pack& w, const Difference<Dim>& d) {
  Difference<Dim> out = d;
  out.x = w * d.x, out.y = w * d.y;
  if constexpr (Dim == 3) out.z = w * d.z;
  return out;
}
template <int Dim>
COURANT_INLINE Difference<Dim> less(const Difference<Dim>& a, const Difference<Dim>& b) {
  Difference<Dim> out = a;
  out.x = a.x - b.x, out.y = a.y - b.y;
  if constexpr (Dim == 3) out.z = a.z - b.z;
  return out;
}

template <int Dim>
void renormal_rates(const RenormalArrays& a, const NeighbourLists& lists) {
  const Real hinv = 1 / a.h0, norm = gradient_norm<CubicSpline, Dim>(a.h0);
  const Pack tiny = Pack::of(tiny_distance2 * a.h0 * a.h0);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Places<Dim> xi(a.x, i, count), vi(a.v, i, count);
    Dyads<Dim> moment, gradient;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), u(vi, a.v, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2), R = r2 * rinv * hinv;
      const Pack shape = gradient_shape<CubicSpline>(R, rinv);
      const Pack bend = CubicSpline::half_curvature(R) * (2 * hinv) - shape,
                 along = dot(u, d) * (rinv * rinv);
      moment.add(times(shape * a.V[j], d), d);
      // grad W less half a step of its change, over the norm
      const Difference<Dim> later = times(a.half_step * a.V[j] * shape, u);
      gradient.add(u, less(times(a.V[j] * (shape - a.half_step * bend * along), d), later));
    }
    moment.store(a.moment, i, count, -norm);
    gradient.store(a.gradient, i, count, norm);
  }
}

/// Adds B . a, B(k) the components of a symmetric tensor.
template <int Dim, class Tensor, class Vector>
COURANT_INLINE void add_product(Sum<Dim>& to, const Tensor& B, const Vector& a) {
  to.x += B(0) * a.x + B(3) * a.y;
  to.y += B(3) * a.x + B(1) * a.y;
  if constexpr (Dim == 3) {
    to.x += B(5) * a.z;
    to.y += B(4) * a.z;
    to.z += B(5) * a.x + B(4) * a.y + B(2) * a.z;
  }
}

template <int Dim>
void renormal_forces(const RenormalArrays& a, const NeighbourLists& lists) {
  const Real hinv = 1 / a.h0, norm = gradient_norm<CubicSpline, Dim>(a.h0);
  const Pack tiny = Pack::of(tiny_distance2 * a.h0 * a.h0);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Places<Dim> xi(a.x, i, count);
    Sum<Dim> own, others;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2);
      const Pack w = gradient_shape<CubicSpline>(r2 * rinv * hinv, rinv) * a.V[j];
      own.add(w, d);
      add_product(
          others, [&](int k) { return a.excess[k][j]; }, times(w * a.p[j], d));
    }
    const Pack pi = Pack::load(a.p + i, count);
    add_product(
        others, [&](int k) { return pi * Pack::load(a.excess[k] + i, count); }, own);
    others.add_to(a.f, i, count, -norm * Pack::load(a.V + i, count));
  }
}

}  // namespace

RenormalLoop renormal_rates_loop(int dim) {
  return dim == 2 ? &renormal_rates<2> : &renormal_rates<3>;
}
RenormalLoop renormal_forces_loop(int dim) {
  return dim == 2 ? &renormal_forces<2> : &renormal_forces<3>;
}

}  // namespace courant::COURANT_SIMD
