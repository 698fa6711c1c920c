// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/options/pair_viscosity_loops.hpp"

#include "sph/kernel/kernel_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

template <class Kernel, int Dim, bool UniformH>
void pair_viscosity(const PairViscosityArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Pack hi = Pack::load(a.h + i, count), hinv = 1 / hi, norm = gradient_norm<Dim>(kernel, hinv);
    const Pack tiny = tiny_distance2 * hi * hi, mu = Pack::load(a.mu + i, count);
    const Positions<Dim> xi(a.x, i, count), vi(a.v, i, count);
    Sum<Dim> force;
    Pack power = Pack::zero();
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), u(vi, a.v, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2);
      const Pack w = mean_gradient<Dim, UniformH>(kernel, r2 * rinv, hinv, a.h, j, norm) * rinv * a.V[j];
      const Pack drag = w * (mu + a.mu[j]);
      force.add(drag, u);
      power += drag * dot(u, u);
    }
    const Pack factor = norm * Pack::load(a.V + i, count);
    force.add_to(a.f, i, count, factor);
    (0 - 0.5 * factor * power).store(a.heat + i, count);
  }
}

}  // namespace

PairViscosityLoop pair_viscosity_loop(KernelChoice choice, int dim, bool uniform_h) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> PairViscosityLoop {
    if (dim == 2) return uniform_h ? &pair_viscosity<Kernel, 2, true> : &pair_viscosity<Kernel, 2, false>;
    return uniform_h ? &pair_viscosity<Kernel, 3, true> : &pair_viscosity<Kernel, 3, false>;
  });
}

}  // namespace courant::COURANT_SIMD
