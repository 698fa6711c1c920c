// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/options/renormal_loops.hpp"

#include "sph/kernel/kernel_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

template <int Dim>
COURANT_INLINE Difference<Dim> less(const Difference<Dim>& a, const Difference<Dim>& b) {
  Difference<Dim> out = a;
  out.x = a.x - b.x, out.y = a.y - b.y;
  if constexpr (Dim == 3) out.z = a.z - b.z;
  return out;
}

template <class Kernel, int Dim>
void renormal_rates(const RenormalArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Pack hinv = 1 / Pack::load(a.h + i, count), norm = gradient_norm<Dim>(kernel, hinv);
    const Pack tiny = tiny_distance2 / (hinv * hinv);
    const Positions<Dim> xi(a.x, i, count), vi(a.v, i, count);
    Dyads<Dim> moment, gradient;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), u(vi, a.v, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2), R = r2 * rinv * hinv;
      const Pack shape = gradient_shape(kernel, R, rinv);
      // as MovingShape of pair_sums.hpp: a pair that passes closely turns no faster than over half a step
      Pack turning = shape;
      if (kernel.kink) turning *= r2 * rinv * rsqrt(r2 + a.half_step * a.half_step * dot(u, u));
      const Pack bend = kernel.half_curvature(R) * (2 * hinv) - turning, along = dot(u, d) * (rinv * rinv);
      moment.add(times(shape * a.V[j], d), d);
      // grad W less half a step of its change, over the norm
      const Difference<Dim> later = times(a.half_step * a.V[j] * turning, u);
      gradient.add(u, less(times(a.V[j] * (shape - a.half_step * bend * along), d), later));
    }
    moment.store(a.moment, i, count, 0 - norm);
    gradient.store(a.gradient, i, count, norm);
  }
}

/// (p - tau) . a, of eight particles or of one
template <int Dim, class Pressure, class Stress>
COURANT_INLINE Difference<Dim> stress_on(const Pressure& p, const Stress& tau, const Difference<Dim>& a) {
  Difference<Dim> out = times(Pack::zero() + p, a);
  add_product(
      out, [&](int c) { return Pack::zero() - tau(c); }, a);
  return out;
}
template <int Dim, class Tensor>
COURANT_INLINE Difference<Dim> product(const Tensor& B, const Difference<Dim>& a) {
  Difference<Dim> out = times(Pack::zero(), a);
  add_product(out, B, a);
  return out;
}

/// Each pressure with its own matrix, or with the partner's (reverse).
template <class Kernel, int Dim, bool UniformH, RenormalForce what>
void renormal_forces(const RenormalArrays& a, const NeighbourLists& lists) {
  constexpr bool reverse = what == RenormalForce::reverse;
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Pack hinv = 1 / Pack::load(a.h + i, count), norm = gradient_norm<Dim>(kernel, hinv);
    const Pack tiny = tiny_distance2 / (hinv * hinv);
    const Positions<Dim> xi(a.x, i, count);
    const Pack pi = Pack::load(a.p + i, count);
    Difference<Dim> own = times(Pack::zero(), Difference<Dim>(xi, a.x, i));
    Sum<Dim> others;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2);
      const Pack w = gradient_shape(kernel, r2 * rinv * hinv, rinv) * a.V[j];
      Pack wj = w;  // with h_j
      if constexpr (!UniformH)
        wj = gradient_shape(kernel, r2 * rinv * (1 / a.h[j]), rinv) * a.V[j] *
             gradient_norm<Dim>(kernel, a.h[j]) / norm;
      const Pack mine = reverse ? w * a.p[j] : w;
      own.x += mine * d.x, own.y += mine * d.y;
      if constexpr (Dim == 3) own.z += mine * d.z;
      const auto excess = [&](int c) { return a.excess[c][j]; };
      if constexpr (what == RenormalForce::stress)
        others.add(stress_on(
            a.p[j], [&](int c) { return a.tau[c][j]; }, product(excess, times(wj, d))));
      else
        add_product(others, excess, times(wj * (reverse ? pi : Pack::of(a.p[j])), d));
    }
    const auto excess = [&](int c) { return Pack::load(a.excess[c] + i, count); };
    const auto tau = [&](int c) { return Pack::load(a.tau[c] + i, count); };
    if constexpr (what == RenormalForce::stress)
      others.add(stress_on(pi, tau, product(excess, own)));
    else
      add_product(others, excess, reverse ? own : times(pi, own));
    others.add_to(a.f, i, count, 0 - norm * Pack::load(a.V + i, count));
  }
}

}  // namespace

RenormalLoop renormal_rates_loop(KernelChoice choice, int dim) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> RenormalLoop {
    return dim == 2 ? &renormal_rates<Kernel, 2> : &renormal_rates<Kernel, 3>;
  });
}
RenormalLoop renormal_forces_loop(KernelChoice choice, int dim, bool uniform_h, RenormalForce what) {
  const auto of = [&]<class Kernel, int Dim, bool UniformH>() -> RenormalLoop {
    switch (what) {
      case RenormalForce::reverse:
        return &renormal_forces<Kernel, Dim, UniformH, RenormalForce::reverse>;
      case RenormalForce::stress:
        return &renormal_forces<Kernel, Dim, UniformH, RenormalForce::stress>;
      default:
        return &renormal_forces<Kernel, Dim, UniformH, RenormalForce::pressure>;
    }
  };
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> RenormalLoop {
    if (dim == 2)
      return uniform_h ? of.template operator()<Kernel, 2, true>()
                       : of.template operator()<Kernel, 2, false>();
    return uniform_h ? of.template operator()<Kernel, 3, true>() : of.template operator()<Kernel, 3, false>();
  });
}

}  // namespace courant::COURANT_SIMD
