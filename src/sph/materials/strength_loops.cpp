// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/materials/strength_loops.hpp"

#include "sph/kernel/kernel_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

template <class Kernel, int Dim>
void spin(const StrengthArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Positions<Dim> xi(a.x, i, count), vi(a.v, i, count);
    const Pack hi = Pack::load(a.h + i, count), hinv = 1 / hi, tiny = tiny_distance2 * hi * hi;
    Pack wx = Pack::zero(), wy = wx, wz = wx;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), u(vi, a.v, j);
      const Pack r2 = dot_plus(d, d, tiny), rinv = rsqrt(r2);
      const Pack w = gradient_shape(kernel, r2 * rinv * hinv, rinv) * a.V[j];
      wz += w * (d.x * u.y - d.y * u.x);
      if constexpr (Dim == 3) {
        wx += w * (d.y * u.z - d.z * u.y);
        wy += w * (d.z * u.x - d.x * u.z);
      }
    }
    const Pack factor = -0.5 * gradient_norm<Dim>(kernel, hinv);
    (factor * wx).store(a.spin[0] + i, count);
    (factor * wy).store(a.spin[1] + i, count);
    (factor * wz).store(a.spin[2] + i, count);
  }
}

/// W and its gradient are those of the mean h of a pair.
template <class Kernel, int Dim>
void artificial_stress(const StrengthArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Positions<Dim> xi(a.x, i, count);
    const Pack hi = Pack::load(a.h + i, count), tiny = tiny_distance2 * hi * hi;
    const Pack at_spacing = 0.5 * Pack::load(a.at_spacing + i, count);
    Pack Ri[6];
    for (int c = 0; c < 6; ++c) Ri[c] = Pack::load(a.R[c] + i, count);
    Sum<Dim> force;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j);
      const Pack hinv = 2 / (hi + a.h[j]);
      const Pack r2 = dot_plus(d, d, tiny), rinv = rsqrt(r2), R = r2 * rinv * hinv;
      const Pack ratio = (at_spacing + 0.5 * a.at_spacing[j]) * kernel.shape(R);
      Pack weight = gradient_norm<Dim>(kernel, hinv) * gradient_shape(kernel, R, rinv) * a.V[j];
      for (int power = 0; power < a.n; ++power) weight = weight * ratio;
      Difference<Dim> pair = times(Pack::zero(), d);
      add_product(
          pair, [&](int c) { return weight * (Ri[c] + a.R[c][j]); }, d);
      force.add(pair);
    }
    const Pack Vi = Pack::load(a.V + i, count);
    (Vi * force.x).store(a.f[0] + i, count);
    (Vi * force.y).store(a.f[1] + i, count);
    (Vi * force.z).store(a.f[2] + i, count);
  }
}

}  // namespace

StrengthLoop spin_loop(KernelChoice choice, int dim) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> StrengthLoop {
    return dim == 2 ? &spin<Kernel, 2> : &spin<Kernel, 3>;
  });
}
StrengthLoop artificial_stress_loop(KernelChoice choice, int dim) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> StrengthLoop {
    return dim == 2 ? &artificial_stress<Kernel, 2> : &artificial_stress<Kernel, 3>;
  });
}

}  // namespace courant::COURANT_SIMD
