// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/options/drift_loops.hpp"

#include "sph/kernel/kernel_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

/// A kernel of a pair at distance r without the constant, its slope over h_i and how that changes.
struct Shapes {
  Pack shape, slope, bend, rinv, hinv;
  Pack turning;  ///< slope over r, by which a pair that turns changes its gradient
  template <class Kernel>
  COURANT_INLINE Shapes(const Kernel& kernel, const Pack& r2, const Pack& rinv, const Pack& hinv)
      : shape(kernel.shape(r2 * rinv * hinv)),
        slope(kernel.gradient_factor * kernel.gradient(r2 * rinv * hinv)),
        bend(2 * kernel.gradient_factor * kernel.half_curvature(r2 * rinv * hinv)),
        rinv(rinv),
        hinv(hinv),
        turning(slope * rinv) {}
  /// As MovingShape: a pair that passes closer than it moves in half a step turns no faster than over that
  /// distance. `u2`: the square of its speed.
  template <class Kernel>
  COURANT_INLINE void pass(const Kernel& kernel, const Pack& r2, const Pack& u2, Real half_step) {
    if (kernel.kink) turning = slope * rsqrt(r2 + half_step * half_step * u2);
  }
};

/// v . (grad grad W) . u, but for the kernel's constant.
template <int Dim>
COURANT_INLINE Pack turn(const Shapes& at, const Difference<Dim>& d, const Difference<Dim>& v,
                         const Difference<Dim>& u) {
  const Pack radial = dot(v, d) * dot(u, d) * (at.rinv * at.rinv);
  return at.bend * at.hinv * radial + at.turning * (dot(u, v) - radial);
}

/// What a drift u does to the density, see `drift_rate_loop`.
template <int Dim>
struct DriftRates {
  Pack middle = Pack::zero(), own = Pack::zero(), bend = Pack::zero();
  COURANT_INLINE void add(Real V, const Shapes& at, const Difference<Dim>& d, const Difference<Dim>& v,
                          const Difference<Dim>& u) {
    middle += V * turn(at, d, v, u);
    bend += V * turn(at, d, u, u);
    own += V * (at.slope * at.rinv) * dot(u, d);
  }
  COURANT_INLINE void store_all(const DriftArrays& a, Index i, Index count, const Pack& norm) const {
    const Pack factor = norm * Pack::load(a.rho + i, count), half = a.half_step * factor;
    (Pack::load(a.drhodt + i, count) - half * middle).store(a.drhodt + i, count);
    (factor * own - half * (middle + bend)).store(a.drift_rate + i, count);
  }
};

template <class Kernel, int Dim, bool Correct>
void shifting(const DriftArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Positions<Dim> xi(a.x, i, count);
    const Pack hi = Pack::load(a.h + i, count), hinv = 1 / hi, tiny = tiny_distance2 * hi * hi;
    const Pack at_spacing = Pack::load(a.at_spacing + i, count), spread_i = Pack::load(a.spread + i, count);
    const Positions<Dim> vi(a.v, i, count), ui(a.drifted, i, count);
    Sum<Dim> gradient, normal;
    VelocityGradient<Dim> turning;
    DriftRates<Dim> rates;
    Pack spread = Pack::zero(), filling = Pack::zero();
    Pack edge = max(a.surface - spread_i, Pack::zero());
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2);
      const Difference<Dim> v(vi, a.v, j), u(ui, a.drifted, j);
      Shapes at(kernel, r2, rinv, hinv);
      at.pass(kernel, r2, dot(v, v) + dot(u, u), a.half_step);
      const Pack shape = at.shape, w = at.slope * rinv * a.V[j];
      const Pack ratio = shape * at_spacing, ratio2 = ratio * ratio;
      gradient.add(w * (1 + a.pairing * (ratio2 * ratio2)), d);
      normal.add(w * (a.spread[j] - spread_i), d);
      spread += w * r2;
      filling += shape * a.V[j];
      const Real open = a.surface - a.spread[j];
      if (open > 0) edge += open * positive(kernel.support - r2 * rinv * hinv);
      rates.add(a.V[j], at, d, v, u);
      if constexpr (Correct) turning.add(w, v, d);
    }
    const Pack norm = shape_norm<Dim>(kernel, hinv), slope_norm = norm * hinv;
    store(gradient, a.gradient, i, count, slope_norm);
    store(normal, a.normal, i, count, slope_norm);
    (0 - slope_norm * spread).store(a.new_spread + i, count);
    (norm * filling).store(a.filling + i, count);
    edge.store(a.edge + i, count);
    rates.store_all(a, i, count, slope_norm);
    if constexpr (Correct) turning.store(a.velocity_gradient, i, count, 0 - slope_norm);
  }
}

template <class Kernel, int Dim, bool UniformH, bool Normed>
void xsph(const DriftArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Positions<Dim> xi(a.x, i, count), vi(a.v, i, count);
    const Pack hi = Pack::load(a.h + i, count), hinv = 1 / hi, tiny = tiny_distance2 * hi * hi;
    const Pack mi = Pack::load(a.m + i, count), Vi = Pack::load(a.V + i, count);
    const Pack norm = shape_norm<Dim>(kernel, hinv);
    Sum<Dim> sum;
    Pack filling = Pack::zero();
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), u(vi, a.v, j);
      const Pack r2 = dot(d, d) + tiny, r = r2 * rsqrt(r2);
      Pack w = kernel.shape(r * hinv);
      if constexpr (!UniformH) {
        const Real hj = 1 / a.h[j];
        w = 0.5 * (w + kernel.shape(r * hj) * (kernel.C(Dim) * power<Dim>(hj)) / norm);
      }
      // m_j / mean of m_i/V_i and m_j/V_j
      w = w * (2 * a.m[j] * a.V[j]) * Vi / (mi * a.V[j] + Vi * a.m[j]);
      sum.add(w, u);
      if constexpr (Normed) filling += w;
    }
    store(sum, a.drift, i, count, Normed ? 0 - 1 / filling : 0 - norm);
  }
}

template <class Kernel, int Dim>
void drift_rate(const DriftArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Positions<Dim> xi(a.x, i, count), vi(a.v, i, count), ui(a.drifted, i, count);
    const Pack hi = Pack::load(a.h + i, count), hinv = 1 / hi, tiny = tiny_distance2 * hi * hi;
    DriftRates<Dim> rates;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> d(xi, a.x, j), v(vi, a.v, j), u(ui, a.drifted, j);
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2);
      Shapes at(kernel, r2, rinv, hinv);
      at.pass(kernel, r2, dot(v, v) + dot(u, u), a.half_step);
      rates.add(a.V[j], at, d, v, u);
    }
    rates.store_all(a, i, count, shape_norm<Dim>(kernel, hinv) * hinv);
  }
}

}  // namespace

DriftLoop shifting_loop(KernelChoice choice, int dim, bool correct) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> DriftLoop {
    if (dim == 2) return correct ? &shifting<Kernel, 2, true> : &shifting<Kernel, 2, false>;
    return correct ? &shifting<Kernel, 3, true> : &shifting<Kernel, 3, false>;
  });
}
DriftLoop drift_rate_loop(KernelChoice choice, int dim) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> DriftLoop {
    return dim == 2 ? &drift_rate<Kernel, 2> : &drift_rate<Kernel, 3>;
  });
}
DriftLoop xsph_loop(KernelChoice choice, int dim, bool uniform_h, bool normed) {
  const auto of = [&]<class Kernel, bool Normed>() -> DriftLoop {
    if (dim == 2) return uniform_h ? &xsph<Kernel, 2, true, Normed> : &xsph<Kernel, 2, false, Normed>;
    return uniform_h ? &xsph<Kernel, 3, true, Normed> : &xsph<Kernel, 3, false, Normed>;
  };
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> DriftLoop {
    return normed ? of.template operator()<Kernel, true>() : of.template operator()<Kernel, false>();
  });
}

}  // namespace courant::COURANT_SIMD
