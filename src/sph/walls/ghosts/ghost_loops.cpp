// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/walls/ghosts/ghost_loops.hpp"

#include "sph/core/pair_sums.hpp"

namespace courant::COURANT_SIMD {

namespace {

/// Sums over no neighbour are 0, of which no mean is to be taken.
constexpr Real least_weight = 1e-12;  // of sum_j V_j W without the kernel's constant, over h^Dim

/// Pairs that none of the eight has within its support may be left out.
template <class Kernel>
COURANT_INLINE Pack reach2(const Kernel& kernel, Real h) {
  return Pack::of(kernel.support * kernel.support * h * h);
}

/// Calls `f` with the type of the kernel where it is a usual one beside walls, else with that of any.
template <class F>
auto with_ghost_kernel(KernelChoice choice, const F& f) {
#if COURANT_SIMD_BYTES > 16 && !defined(__SANITIZE_ADDRESS__)
  if (choice == KernelChoice::wendland_c4) return f(std::type_identity<WendlandC4>{});
#endif
  return with_loop_kernel(choice, f);
}

/// A kernel without its constant, of a pair where it was in the middle of the step. Exact: what ghosts share
/// out by it must be what they were given.
template <class Kernel, int Dim>
COURANT_INLINE Pack shape_before(const Kernel& kernel, const GhostArrays& a, Difference<Dim> d,
                                 const Difference<Dim>& u, const Pack& tiny, const Pack& hinv) {
  d.advance(-a.half_step, u);
  const Pack r2 = dot_plus(d, d, tiny);
  return kernel.shape(r2 * rsqrt(r2) * hinv);
}

template <class Kernel, int Dim>
void rates_of_ghosts(const GhostArrays& arrays, const NeighbourLists& lists) {
  const GhostArrays a = arrays;
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  const Real norm = gradient_norm<Dim>(kernel, a.h);
  const Pack hinv = Pack::of(1 / a.h), tiny = Pack::of(tiny_distance2 * a.h * a.h), two_hinv = 2 * hinv;
  const Pack reach = reach2(kernel, a.h);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Positions<Dim> xi(a.x, i, count), vi(a.v, i, count);
    Pack weight = Pack::zero(), rate = weight;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), u(vi, a.v, j);
      const Pack r2 = dot_plus(d, d, tiny);
      if (!any_less(r2, reach)) continue;
      const Pack rinv = rsqrt(r2), R = r2 * rinv * hinv, u_dot_d = dot(u, d);
      const MovingShape<Kernel> moving(kernel, R, rinv, two_hinv, u_dot_d * rinv, dot(u, u), r2, a.half_step);
      rate += a.V[j] * (moving.shape * u_dot_d - a.half_step * moving.later);
      weight += a.V[j] * shape_before(kernel, a, d, u, tiny, hinv);
    }
    const Pack all = max(weight, Pack::of(least_weight * power<Dim>(a.h)));
    const Pack volume_rate = norm * Pack::load(a.V + i, count) * rate;
    volume_rate.store(a.volume_rate + (i - a.first), count);
    (volume_rate / all).store(a.squeeze + (i - a.first), count);
  }
}

template <class Kernel, int Dim>
void squeezed(const GhostArrays& arrays, const NeighbourLists& lists) {
  const GhostArrays a = arrays;
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  const Pack hinv = Pack::of(1 / a.h), tiny = Pack::of(tiny_distance2 * a.h * a.h);
  const Pack reach = reach2(kernel, a.h);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    if (lists.start[g] == lists.start[g + 1]) continue;
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Positions<Dim> xi(a.x, i, count), vi(a.v, i, count);
    Pack sum = Pack::zero();
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j);
      if (!any_less(dot_plus(d, d, tiny), reach)) continue;
      const Difference<Dim> u(vi, a.v, j);
      sum += a.squeeze[j - a.first] * shape_before(kernel, a, d, u, tiny, hinv);
    }
    (Pack::load(a.drhodt + i, count) + Pack::load(a.rho + i, count) * sum).store(a.drhodt + i, count);
  }
}

template <class Kernel, int Dim, bool Stress>
void pressures(const GhostArrays& arrays, const NeighbourLists& lists) {
  const GhostArrays a = arrays;
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  const Real norm = gradient_norm<Dim>(kernel, a.h);
  const Pack hinv = Pack::of(1 / a.h), tiny = Pack::of(tiny_distance2 * a.h * a.h);
  const Pack reach = reach2(kernel, a.h);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes, at = i - a.first;
    const Positions<Dim> xi(a.x, i, count), carried(a.g, at, count);
    Pack weight = Pack::zero(), mean = weight, rise = weight;
    Sum<Dim> slope, push;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j);
      const Pack r2 = dot_plus(d, d, tiny);
      if (!any_less(r2, reach)) continue;
      const Pack rinv = rsqrt(r2), R = r2 * rinv * hinv;
      const Pack shape = kernel.shape(R), w = a.V[j] * shape;
      Pack height = carried.x * d.x + carried.y * d.y;
      if constexpr (Dim == 3) height += carried.z * d.z;
      weight += w;
      mean += a.p[j] * w;
      rise += a.m[j] * shape * height;
      const Pack gradient = a.V[j] * gradient_shape(kernel, R, rinv);
      slope.add(gradient, d);
      push.add(a.p[j] * gradient, d);
      if constexpr (Stress) {
        const Pack of_stress = 0 - gradient;
        add_product(
            push, [&](int c) { return of_stress * a.tau[c][j]; }, d);
      }
    }
    const Pack over = 1 / max(weight, Pack::of(least_weight * power<Dim>(a.h)));
    mean *= over;
    const Pack p = mean + over * rise;
    p.store(a.pressure + at, count);
    (p - mean).store(a.excess + at, count);
    const Pack factor = (0 - norm) * Pack::load(a.V + i, count);
    (factor * (push.x + p * slope.x)).store(a.force[0] + at, count);
    (factor * (push.y + p * slope.y)).store(a.force[1] + at, count);
    if constexpr (Dim == 3) (factor * (push.z + p * slope.z)).store(a.force[2] + at, count);
  }
}

}  // namespace

GhostLoop ghost_rate_loop(KernelChoice choice, int dim) {
  return with_ghost_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> GhostLoop {
    return dim == 2 ? &rates_of_ghosts<Kernel, 2> : &rates_of_ghosts<Kernel, 3>;
  });
}
GhostLoop squeezed_by_ghosts_loop(KernelChoice choice, int dim) {
  return with_ghost_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> GhostLoop {
    return dim == 2 ? &squeezed<Kernel, 2> : &squeezed<Kernel, 3>;
  });
}
GhostLoop ghost_pressure_loop(KernelChoice choice, int dim, bool stress) {
  return with_ghost_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> GhostLoop {
    if (dim == 2) return stress ? &pressures<Kernel, 2, true> : &pressures<Kernel, 2, false>;
    return stress ? &pressures<Kernel, 3, true> : &pressures<Kernel, 3, false>;
  });
}

}  // namespace courant::COURANT_SIMD
