// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/turbulence/turbulence_loops.hpp"

#include "sph/kernel/kernel_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

/// How k and epsilon spread; see `turbulence_loop`.
struct Spreading {
  Pack k, epsilon, eddy;
  Pack k_sum = Pack::zero(), epsilon_sum = Pack::zero();
  COURANT_INLINE Spreading(const TurbulenceArrays& a, Index i, Index count)
      : k(Pack::load(a.k + i, count)),
        epsilon(Pack::load(a.epsilon + i, count)),
        eddy(Pack::load(a.eddy + i, count)) {}
  COURANT_INLINE void add(const TurbulenceArrays& a, std::ptrdiff_t j, const Pack& w) {
    const Pack both = eddy + a.eddy[j];
    k_sum += w * (2 * a.nu + both * (1 / a.sigma_k)) * (k - a.k[j]);
    epsilon_sum += w * (2 * a.nu + both * (1 / a.sigma_e)) * (epsilon - a.epsilon[j]);
  }
};

template <class Kernel, int Dim, bool UniformH, bool KEpsilon>
void turbulence(const TurbulenceArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Pack hi = Pack::load(a.h + i, count), hinv = 1 / hi, norm = gradient_norm<Dim>(kernel, hinv);
    const Pack tiny = tiny_distance2 * hi * hi;
    const Positions<Dim> xi(a.x, i, count), vi(a.v, i, count);
    const Pack mu = Pack::load(a.mu + i, count);
    VelocityGradient<Dim> gradient;
    Sum<Dim> slope, force;
    Pack power = Pack::zero();
    Dyads<Dim> moment;
    const auto begin = [&] {
      if constexpr (KEpsilon)
        return Spreading(a, i, count);
      else
        return 0;
    };
    auto spreading = begin();
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), u(vi, a.v, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2);
      const Pack w = mean_gradient<Dim, UniformH>(kernel, r2 * rinv, hinv, a.h, j, norm) * rinv * a.V[j];
      const Difference<Dim> wd = times(w, d);
      moment.add(wd, d);
      slope.add(wd);
      gradient.add(w, u, d);
      const Pack drag = w * (mu + a.mu[j]);
      force.add(drag, u);
      power += drag * dot(u, u);
      if constexpr (KEpsilon) spreading.add(a, j, w);
    }
    const Pack factor = norm * Pack::load(a.V + i, count);
    force.add_to(a.f, i, count, factor);
    (0 - 0.5 * factor * power).store(a.heat + i, count);
    moment.store(a.moment, i, count, 0 - norm);
    store(slope, a.slope, i, count, norm);
    gradient.store(a.gradient, i, count, 0 - norm);
    if constexpr (KEpsilon) {
      (norm * spreading.k_sum).store(a.k_flow + i, count);
      (norm * spreading.epsilon_sum).store(a.epsilon_flow + i, count);
    }
  }
}

}  // namespace

TurbulenceLoop turbulence_loop(KernelChoice choice, int dim, bool uniform_h, bool k_epsilon) {
  const auto of = [&]<class Kernel, int Dim, bool UniformH>() -> TurbulenceLoop {
    return k_epsilon ? &turbulence<Kernel, Dim, UniformH, true> : &turbulence<Kernel, Dim, UniformH, false>;
  };
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> TurbulenceLoop {
    if (dim == 2)
      return uniform_h ? of.template operator()<Kernel, 2, true>()
                       : of.template operator()<Kernel, 2, false>();
    return uniform_h ? of.template operator()<Kernel, 3, true>() : of.template operator()<Kernel, 3, false>();
  });
}

}  // namespace courant::COURANT_SIMD
