// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/options/riemann_loops.hpp"

#include "sph/kernel/kernel_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

template <class Kernel, int Dim, bool UniformH>
void momentum(const RiemannArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Pack hinv = inverse_h<UniformH>(a.h, a.h0, i, count), norm = gradient_norm<Dim>(kernel, hinv);
    const Pack tiny = tiny_distance2 / (hinv * hinv);
    const Positions<Dim> xi(a.x, i, count), vi(a.v, i, count);
    const Pack Vi = Pack::load(a.V + i, count), rhoi = Pack::load(a.m + i, count) / Vi;
    const Pack ci = Pack::load(a.c + i, count);
    Sum<Dim> force;
    Pack power = Pack::zero();
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), u(vi, a.v, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2), u_dot_d = dot(u, d);
      const Pack approach = positive(0 - u_dot_d) * rinv;
      const Pack excess = approach * min(a.eta * approach, 0.5 * (ci + a.c[j]));
      const Pack w = mean_gradient<Dim, UniformH>(kernel, r2 * rinv, hinv, a.h, j, norm) * rinv * a.V[j] *
                     (excess * (rhoi + a.m[j] / a.V[j]));
      force.add(w, d);
      power += w * u_dot_d;
    }
    const Pack factor = 0.5 * norm * Vi;
    force.add_to(a.f, i, count, 0 - factor);
    (0.5 * factor * power).store(a.heat + i, count);
  }
}

template <class Kernel, int Dim, bool UniformH>
void mass(const RiemannArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Pack hinv = inverse_h<UniformH>(a.h, a.h0, i, count), norm = gradient_norm<Dim>(kernel, hinv);
    const Pack tiny = tiny_distance2 / (hinv * hinv);
    const Positions<Dim> xi(a.x, i, count);
    const Pack rhoi = Pack::load(a.m + i, count) / Pack::load(a.V + i, count);
    const Pack ci = Pack::load(a.c + i, count), pi = Pack::load(a.p + i, count);
    const Pack potential = Pack::load(a.potential + i, count);
    // 1 where the pressure is not cut off, 0 where it is
    const Pack held = min(positive(1e30 * (pi - a.pc)), Pack::of(1));
    Pack sum = Pack::zero(), weights = Pack::zero();
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j);
      const Pack r2 = dot(d, d) + tiny, r = r2 * rsqrt(r2);
      const Pack density = rhoi + a.m[j] / a.V[j];
      const Real Vj = a.p[j] > a.pc ? a.V[j] : 0;
      const Pack w =
          held * mean_gradient<Dim, UniformH>(kernel, r, hinv, a.h, j, norm) * Vj / (density * (ci + a.c[j]));
      sum += w * (2 * (pi - a.p[j]) + density * (potential - a.potential[j]));
      weights += w;
    }
    (2 * norm * rhoi * sum).store(a.rate + i, count);
    (0 - 4 * norm * rhoi * ci * ci * weights).store(a.decay + i, count);
  }
}

}  // namespace

RiemannLoop riemann_momentum_loop(KernelChoice choice, int dim, bool uniform_h) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> RiemannLoop {
    if (dim == 2) return uniform_h ? &momentum<Kernel, 2, true> : &momentum<Kernel, 2, false>;
    return uniform_h ? &momentum<Kernel, 3, true> : &momentum<Kernel, 3, false>;
  });
}
RiemannLoop riemann_mass_loop(KernelChoice choice, int dim, bool uniform_h) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> RiemannLoop {
    if (dim == 2) return uniform_h ? &mass<Kernel, 2, true> : &mass<Kernel, 2, false>;
    return uniform_h ? &mass<Kernel, 3, true> : &mass<Kernel, 3, false>;
  });
}

}  // namespace courant::COURANT_SIMD
