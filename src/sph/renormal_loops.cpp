// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/renormal_loops.hpp"

#include "sph/pair_sums.hpp"

namespace courant::COURANT_SIMD {

namespace {

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

/// Each pressure with its own matrix, or with the partner's (Reverse).
template <int Dim, bool Reverse>
void renormal_forces(const RenormalArrays& a, const NeighbourLists& lists) {
  const Real hinv = 1 / a.h0, norm = gradient_norm<CubicSpline, Dim>(a.h0);
  const Pack tiny = Pack::of(tiny_distance2 * a.h0 * a.h0);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Places<Dim> xi(a.x, i, count);
    const Pack pi = Pack::load(a.p + i, count), one = Pack::of(1);
    Sum<Dim> own, others;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2);
      const Pack w = gradient_shape<CubicSpline>(r2 * rinv * hinv, rinv) * a.V[j], wp = w * a.p[j];
      own.add(Reverse ? wp : w, d);
      add_product(
          others, [&](int k) { return a.excess[k][j]; }, times(Reverse ? w * pi : wp, d));
    }
    add_product(
        others, [&](int k) { return (Reverse ? one : pi) * Pack::load(a.excess[k] + i, count); }, own);
    others.add_to(a.f, i, count, -norm * Pack::load(a.V + i, count));
  }
}

}  // namespace

RenormalLoop renormal_rates_loop(int dim) {
  return dim == 2 ? &renormal_rates<2> : &renormal_rates<3>;
}
RenormalLoop renormal_forces_loop(int dim, bool reverse) {
  if (reverse) return dim == 2 ? &renormal_forces<2, true> : &renormal_forces<3, true>;
  return dim == 2 ? &renormal_forces<2, false> : &renormal_forces<3, false>;
}

}  // namespace courant::COURANT_SIMD
