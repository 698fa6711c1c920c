// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/options/frozen_loops.hpp"

#include "sph/core/pair_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

constexpr std::ptrdiff_t prefetch_distance = 16;  ///< entries from the one in work to the one asked for

/// Of entry k.
template <int Dim>
COURANT_INLINE Difference<Dim> gradient_of(const FrozenLists& lists, std::ptrdiff_t k) {
  const Fixed16* kept = lists.gradients + k * (Dim * lanes);
  __builtin_prefetch(kept + prefetch_distance * Dim * lanes);
  Difference<Dim> G;
  G.x = Pack::widen(kept), G.y = Pack::widen(kept + lanes), G.z = Pack::zero();
  if constexpr (Dim == 3) G.z = Pack::widen(kept + 2 * lanes);
  return G;
}

template <int Dim, bool Viscous, bool Quadratic, bool Gradient>
void rates(const PairArrays& a, const FrozenLists& lists) {
  const std::ptrdiff_t stride = lists.factor_count * lanes;
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Positions<Dim> vi(a.v, i, count);
    Pack div = Pack::zero(), power = Pack::zero();
    Dyads<Dim> gradient;
    Sum<Dim> force;
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> G = gradient_of<Dim>(lists, k), u(vi, a.v, j);
      const Pack u_dot_G = dot(u, G);
      div += u_dot_G * a.V[j];
      if constexpr (Viscous) {
        const Float16* factor = lists.factors + k * stride;
        __builtin_prefetch(factor + prefetch_distance * stride);
        const Pack approach = max(u_dot_G, Pack::zero());
        Pack viscous = Pack::widen(factor);
        if constexpr (Quadratic) viscous += Pack::widen(factor + lanes) * approach;
        viscous *= approach;
        force.add(viscous, G);
        power += viscous * u_dot_G;
      }
      if constexpr (Gradient) gradient.add(u, times(Pack::of(a.V[j]), G));
    }
    (Pack::load(a.rho + i, count) * lists.norm * div).store(a.drhodt + i, count);
    if constexpr (Viscous) {
      const Pack factor = Pack::of(lists.norm * lists.mV);
      force.add_to(a.f, i, count, 0 - factor);
      (0.5 * factor * power).store(a.heat + i, count);  // each partner takes half
    }
    if constexpr (Gradient) gradient.store(a.strain, i, count, -lists.norm);
  }
}

template <int Dim, bool Stress, bool Diffusion>
void forces(const PairArrays& a, const FrozenLists& lists) {
  const std::ptrdiff_t stride = lists.factor_count * lanes;
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Pack pi = Pack::load(a.p + i, count);
    Pack ti[6];
    if constexpr (Stress)
      for (int k = 0; k < 6; ++k) ti[k] = Pack::load(a.tau[k] + i, count);
    const Pack rhoi = Diffusion ? Pack::load(a.rho + i, count) : Pack::zero();
    const Pack potential = Diffusion ? Pack::load(a.potential + i, count) : Pack::zero();
    Sum<Dim> push, pull;
    Pack spread = Pack::zero();
    for (Index k = lists.start[g]; k < lists.start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const Difference<Dim> G = gradient_of<Dim>(lists, k);
      push.add((pi + a.p[j]) * a.V[j], G);
      if constexpr (Diffusion)
        spread += Pack::widen(lists.factors + (k + 1) * stride - lanes) *
                  (a.V[j] * (a.p[j] - pi + rhoi * (a.potential[j] - potential)));
      if constexpr (Stress)
        add_product(
            pull, [&](int c) { return (ti[c] + a.tau[c][j]) * a.V[j]; }, G);
    }
    const Pack factor = Pack::load(a.V + i, count) * lists.norm;
    push.add_to(a.f, i, count, 0 - factor);
    if constexpr (Stress) pull.add_to(a.f, i, count, factor);
    if constexpr (Diffusion)
      (2 * a.delta * lists.norm * spread / Pack::load(a.c + i, count)).store(a.diffusion + i, count);
  }
}

template <int Dim, bool Viscous, bool Quadratic>
FrozenLoop rates_of(const FrozenChoice& c) {
  return c.gradient ? &rates<Dim, Viscous, Quadratic, true> : &rates<Dim, Viscous, Quadratic, false>;
}
template <int Dim>
FrozenLoop rates_of(const FrozenChoice& c) {
  if (!c.viscous) return rates_of<Dim, false, false>(c);
  return c.quadratic ? rates_of<Dim, true, true>(c) : rates_of<Dim, true, false>(c);
}
template <int Dim>
FrozenLoop forces_of(const FrozenChoice& c) {
  if (c.diffusion) return c.stress ? &forces<Dim, true, true> : &forces<Dim, false, true>;
  return c.stress ? &forces<Dim, true, false> : &forces<Dim, false, false>;
}

}  // namespace

FrozenLoop frozen_rates_loop(const FrozenChoice& c) {
  return c.dim == 2 ? rates_of<2>(c) : rates_of<3>(c);
}
FrozenLoop frozen_forces_loop(const FrozenChoice& c) {
  return c.dim == 2 ? forces_of<2>(c) : forces_of<3>(c);
}

}  // namespace courant::COURANT_SIMD
