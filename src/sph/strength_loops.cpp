// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/strength_loops.hpp"

#include "sph/pair_sums.hpp"

namespace courant::COURANT_SIMD {

namespace {

template <class Kernel, int Dim>
void spin(const StrengthArrays& a, const NeighbourLists& lists) {
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Places<Dim> xi(a.x, i, count), vi(a.v, i, count);
    const Pack hi = Pack::load(a.h + i, count), hinv = 1 / hi, tiny = tiny_distance2 * hi * hi;
    Pack wx = Pack::zero(), wy = wx, wz = wx;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), u(vi, a.v, j);
      const Pack r2 = dot_plus(d, d, tiny), rinv = rsqrt(r2);
      const Pack w = gradient_shape<Kernel>(r2 * rinv * hinv, rinv) * a.V[j];
      wz += w * (d.x * u.y - d.y * u.x);
      if constexpr (Dim == 3) {
        wx += w * (d.y * u.z - d.z * u.y);
        wy += w * (d.z * u.x - d.x * u.z);
      }
    }
    const Pack factor = -0.5 * gradient_norm<Kernel, Dim>(hinv);
    (factor * wx).store(a.spin[0] + i, count);
    (factor * wy).store(a.spin[1] + i, count);
    (factor * wz).store(a.spin[2] + i, count);
  }
}

/// The kernel without its constant, for each of the lanes.
template <class Kernel>
COURANT_INLINE Pack shape(const Pack& R) {
  Real values[lanes];
  R.store(values, lanes);
  for (Index k = 0; k < lanes; ++k) values[k] = Kernel::shape(values[k]);
  return Pack::load(values, lanes);
}

template <class Kernel, int Dim>
void artificial_stress(const StrengthArrays& a, const NeighbourLists& lists) {
  const Real hinv = 1 / a.h0;
  const Real norm = gradient_norm<Kernel, Dim>(a.h0);
  const Pack tiny = Pack::of(tiny_distance2 * a.h0 * a.h0);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Places<Dim> xi(a.x, i, count);
    Pack Ri[6];
    for (int c = 0; c < 6; ++c) Ri[c] = Pack::load(a.R[c] + i, count);
    Sum<Dim> force;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j);
      const Pack r2 = dot_plus(d, d, tiny), rinv = rsqrt(r2), R = r2 * rinv * hinv;
      const Pack ratio = a.at_spacing * shape<Kernel>(R);
      Pack weight = gradient_shape<Kernel>(R, rinv) * a.V[j];
      for (int power = 0; power < a.n; ++power) weight = weight * ratio;
      Difference<Dim> pair = times(Pack::zero(), d);
      add_product(
          pair, [&](int c) { return weight * (Ri[c] + a.R[c][j]); }, d);
      force.add(pair);
    }
    const Pack factor = norm * Pack::load(a.V + i, count);
    (factor * force.x).store(a.f[0] + i, count);
    (factor * force.y).store(a.f[1] + i, count);
    (factor * force.z).store(a.f[2] + i, count);
  }
}

template <template <class> class Choice>
StrengthLoop loop_for(KernelChoice kernel, int dim) {
  switch (kernel) {
    case KernelChoice::quintic_spline:
      return Choice<QuinticSpline>::of(dim);
    case KernelChoice::quadratic_spline:
      return Choice<QuadraticSpline>::of(dim);
    case KernelChoice::quartic_spline:
      return Choice<QuarticSpline>::of(dim);
    case KernelChoice::wendland_c2:
      return Choice<WendlandC2>::of(dim);
    case KernelChoice::wendland_c4:
      return Choice<WendlandC4>::of(dim);
    default:
      return Choice<CubicSpline>::of(dim);
  }
}
template <class Kernel>
struct Spin {
  static StrengthLoop of(int dim) { return dim == 2 ? &spin<Kernel, 2> : &spin<Kernel, 3>; }
};
template <class Kernel>
struct ArtificialStress {
  static StrengthLoop of(int dim) {
    return dim == 2 ? &artificial_stress<Kernel, 2> : &artificial_stress<Kernel, 3>;
  }
};

}  // namespace

StrengthLoop spin_loop(KernelChoice kernel, int dim) {
  return loop_for<Spin>(kernel, dim);
}
StrengthLoop artificial_stress_loop(KernelChoice kernel, int dim) {
  return loop_for<ArtificialStress>(kernel, dim);
}

}  // namespace courant::COURANT_SIMD
