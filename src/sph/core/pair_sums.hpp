#pragma once
// The loops over pairs for a kernel as a type, included by files *_loops.cpp, which are compiled once for
// each instruction set; see docs/architecture.md.
#include "sph/core/pair_loops.hpp"
#include "sph/kernel/kernel_packs.hpp"
#include "sph/options/frozen_loops.hpp"

namespace courant::COURANT_SIMD {

/// The same, and how it changes with time, times u.d: (dW/dr)'/r of the radial velocity q, and what turning
/// does. `u2`: u.u; `half_step`: half of the step. Where the slope is not 0 at r = 0, a pair that passes
/// closer than it moves in half a step turns no faster than over that distance.
template <class Kernel>
struct MovingShape {
  Pack shape, later;
  COURANT_INLINE MovingShape(const Kernel& kernel, const Pack& R, const Pack& rinv, const Pack& two_hinv,
                             const Pack& q, const Pack& u2, const Pack& r2, Real half_step)
      : shape(Pack::zero()), later(Pack::zero()) {
    Pack gradient = Pack::zero(), half_curvature = Pack::zero();
    slopes_at(kernel, R, gradient, half_curvature);
    const Pack q2 = q * q;
    shape = gradient * rinv;
    if (kernel.kink)
      later = half_curvature * two_hinv * q2 + gradient * rsqrt(r2 + half_step * half_step * u2) * (u2 - q2);
    else
      later = half_curvature * two_hinv * q2 + shape * (u2 - q2);
  }
};

/// Rounds a product by itself. Else compilers fuse it with the addition that follows in some variants
/// of a loop and not in others, and last bits depend on which one runs. The baseline has no fused operation.
COURANT_INLINE void round_here([[maybe_unused]] Pack& product) {
#if COURANT_SIMD_BYTES == 64
  for (Native& part : product.part) asm("" : "+v"(part));
#elif COURANT_SIMD_BYTES == 32
  for (Native& part : product.part) asm("" : "+x"(part));
#endif
}
template <int Dim>
COURANT_INLINE void round_here(Difference<Dim>& product) {
  round_here(product.x), round_here(product.y);
  if constexpr (Dim == 3) round_here(product.z);
}

/// Whether entry k, of pairs of r2, may be left out: none of the eight has it within its support.
template <bool UniformH, class Kernel>
COURANT_INLINE bool is_beyond(const Kernel& kernel, const PairArrays& a, const Pack& hi, std::ptrdiff_t j,
                              const Pack& r2) {
  const Pack reach = kernel.support * (UniformH ? hi : max(hi, Pack::of(a.h[j])));
  return !any_less(r2, reach * reach);
}

/// The entries that a group examines, and their content.
template <bool UniformH>
struct Entries {
  const ListSections at;
  Index begin, end;
  COURANT_INLINE Entries(const PairLists& lists, Index g)
      : at(lists.sections[g]), begin(lists.start[g]), end(UniformH ? at.earlier : lists.start[g + 1]) {}
  COURANT_INLINE bool maybe_beyond(Index k) const {
    return UniformH ? k >= at.beyond : k >= at.beyond && (k < at.earlier || k >= at.earlier_beyond);
  }
  /// Where an entry has one, all eight i are particles: only the last group has fewer.
  COURANT_INLINE bool has_partner(Index k) const { return UniformH && k >= at.later && k < at.later_end; }
};

template <class Kernel, int Dim, bool UniformH, bool Viscous, bool Gradient>
void rates(const PairArrays& arrays, const PairLists& all_lists) {
  const PairArrays a = arrays;  // so that nothing that the loop stores can change it
  const PairLists lists = all_lists;
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  constexpr int share_count = rates_shares(Dim, Viscous, Gradient);
  Real nowhere[share_count]{};
  const bool stores = UniformH && lists.kept != nullptr;
  Index kept = 0;
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Positions<Dim> xi(a.x, i, count), vi(a.v, i, count);
    const Pack hi = UniformH ? Pack::of(a.h0) : Pack::load(a.h + i, count);
    const Pack hinv = UniformH ? Pack::of(1 / a.h0) : 1 / hi;
    const Pack norm =
        UniformH ? Pack::of(gradient_norm<Dim>(kernel, a.h0)) : gradient_norm<Dim>(kernel, hinv);
    const Pack tiny = tiny_distance2 * hi * hi, two_hinv = 2 * hinv;
    const Pack mi = Viscous ? Pack::load(a.m + i, count) : Pack::zero();
    const Pack Vi = Pack::load(a.V + i, count);
    const Pack mVi = mi * Vi;
    const Pack qci = Viscous ? 0.5 * Pack::load(a.qc + i, count) : Pack::zero();
    const bool quadratic = Viscous && a.q2 != 0;
    Pack div = Pack::zero(), power = Pack::zero();
    Dyads<Dim> gradient;
    Sum<Dim> force;
    if (stores) lists.kept_start[g] = kept;
    const Entries<UniformH> entries(lists, g);
    PendingShares<share_count> pending(nowhere);
    for (Index k = entries.begin; k < entries.end; ++k) {
      const std::ptrdiff_t j = lists.list[k];
      const bool has_partner = entries.has_partner(k);
      const Difference<Dim> d(xi, a.x, j);
      const Pack r2 = dot_plus(d, d, tiny);
      if (entries.maybe_beyond(k) && is_beyond<UniformH>(kernel, a, hi, j, r2)) continue;
      const Difference<Dim> u(vi, a.v, j);
      const Pack u_dot_d = dot(u, d);
      const Pack rinv = rsqrt(r2);
      const MovingShape<Kernel> moving(kernel, r2 * rinv * hinv, rinv, two_hinv, u_dot_d * rinv, dot(u, u),
                                       r2, a.half_step);
      if (stores) {
        moving.shape.store(lists.g + std::ptrdiff_t(kept) * lanes);
        lists.kept[kept++] = has_partner ? ~Index(j) : Index(j);
      }
      const Pack change = moving.shape * u_dot_d - a.half_step * moving.later;
      div += a.V[j] * change;
      Difference<Dim> drag;
      Pack power_of_pair = Pack::zero();
      if constexpr (Viscous) {
        Pack h = hi, pair = moving.shape;  // (dW/dr)/r / norm, mean of both where h differs
        Pack qc = qci + 0.5 * a.qc[j];
        if constexpr (!UniformH) {
          const Real hj = a.h[j], ratio = gradient_norm<Dim>(kernel, hj);
          h = 0.5 * (hi + hj);
          pair = 0.5 * (pair + gradient_shape(kernel, r2 * rinv * (1 / hj), rinv) * ratio / norm);
        }
        // -m_i m_j Pi pair / 2 with 1/(rho_i + rho_j) = V_i V_j / (m_i V_j + m_j V_i); where all have one h,
        // without its factor h
        const Pack approach = min(u_dot_d, Pack::zero()), D = r2 + 0.01 * (h * h);
        Pack below = D * (mi * a.V[j] + Vi * a.m[j]);
        if (quadratic) qc = qc * D - a.q2 * h * approach, below *= D;
        if constexpr (!UniformH) qc *= h;
        const Pack viscous = approach * qc * (mVi * a.m[j] * a.V[j]) / below * pair;
        drag = times(viscous, d), power_of_pair = viscous * u_dot_d;
        force.add(drag);
        power += power_of_pair;
      }
      if constexpr (Gradient) gradient.add(u, times(moving.shape * a.V[j], d));
      if (has_partner) {
        SharePacks<share_count> shares;
        shares.of[0] = Vi * change;
        if constexpr (Viscous) drag.list(shares.of + 1), shares.of[Dim + 1] = power_of_pair;
        if constexpr (Gradient) {
          Dyads<Dim> own;
          own.add(u, times(moving.shape * Vi, d));
          own.list(shares.of + (Viscous ? Dim + 2 : 1));
        }
        pending.take(shares, lists.shares + (j - lists.task_begin) * share_count);
      }
    }
    pending.add();
    (Pack::load(a.rho + i, count) * norm * div).store(a.drhodt + i, count);
    if constexpr (Viscous) {
      const Pack factor = 2 * norm * (UniformH ? hi : Pack::of(1));
      force.add_to(a.f, i, count, factor);
      (-0.5 * factor * power).store(a.heat + i, count);  // each partner takes half
    }
    if constexpr (Gradient) gradient.store(a.strain, i, count, 0 - norm);
    if (stores) lists.kept_start[g + 1] = kept;
  }
}

template <class Kernel, int Dim, bool UniformH, bool Stress, bool Diffusion, Geometry geometry>
void forces(const PairArrays& arrays, const PairLists& all_lists) {
  const PairArrays a = arrays;  // so that nothing that the loop stores can change it
  const PairLists lists = all_lists;
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  constexpr int share_count = forces_shares(Dim, Diffusion);
  Real nowhere[share_count]{};
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Positions<Dim> xi(a.x, i, count);
    const Pack hi = UniformH ? Pack::of(a.h0) : Pack::load(a.h + i, count);
    const Pack hinv = UniformH ? Pack::of(1 / a.h0) : 1 / hi;
    const Pack norm =
        UniformH ? Pack::of(gradient_norm<Dim>(kernel, a.h0)) : gradient_norm<Dim>(kernel, hinv);
    const Pack tiny = tiny_distance2 * hi * hi, pi = Pack::load(a.p + i, count);
    const Pack Vi = Pack::load(a.V + i, count);
    Pack ti[6];
    if constexpr (Stress)
      for (int k = 0; k < 6; ++k) ti[k] = Pack::load(a.tau[k] + i, count);
    const Pack rhoi = Diffusion ? Pack::load(a.rho + i, count) : Pack::zero();
    const Pack potential = Diffusion ? Pack::load(a.potential + i, count) : Pack::zero();
    Sum<Dim> push;
    Pack spread = Pack::zero();
    const Entries<UniformH> entries(lists, g);
    PendingShares<share_count> pending(nowhere);
    const Index begin = geometry == Geometry::load ? lists.kept_start[g] : entries.begin;
    const Index end = geometry == Geometry::load ? lists.kept_start[g + 1] : entries.end;
    for (Index k = begin; k < end; ++k) {
      Pack w, wj;  // (dW/dr)/r / norm with h_i and with h_j
      Index entry = geometry == Geometry::load ? lists.kept[k] : lists.list[k];
      const bool has_partner = geometry == Geometry::load ? entry < 0 : entries.has_partner(k);
      if (geometry == Geometry::load && has_partner) entry = ~entry;
      const std::ptrdiff_t j = entry;
      const Difference<Dim> d(xi, a.x, j);
      if constexpr (geometry == Geometry::load) {
        w = wj = Pack::load(lists.g + std::ptrdiff_t(k) * lanes);
      } else {
        const Pack r2 = dot_plus(d, d, tiny);
        if (entries.maybe_beyond(k) && is_beyond<UniformH>(kernel, a, hi, j, r2)) continue;
        const Pack rinv = rsqrt(r2);
        w = wj = gradient_shape(kernel, r2 * rinv * hinv, rinv);
        if constexpr (!UniformH)
          wj = gradient_shape(kernel, r2 * rinv * (1 / a.h[j]), rinv) * gradient_norm<Dim>(kernel, a.h[j]) /
               norm;
      }
      const Pack volumes = Vi * a.V[j];
      Difference<Dim> pair = times(volumes * (UniformH ? w * (pi + a.p[j]) : w * pi + wj * a.p[j]), d);
      if constexpr (Stress) {
        const Pack pull = 0 - volumes;
        add_product(
            pair,
            [&](int c) {
              return pull * (UniformH ? w * (ti[c] + a.tau[c][j]) : w * ti[c] + wj * a.tau[c][j]);
            },
            d);
      }
      round_here(pair);
      push.add(pair);
      const Pack dp = Diffusion ? a.p[j] - pi : Pack::zero(),
                 dphi = Diffusion ? a.potential[j] - potential : Pack::zero();
      if constexpr (Diffusion) spread += (w * a.V[j]) * (dp + rhoi * dphi);
      if (has_partner) {
        SharePacks<share_count> shares;
        pair.list(shares.of);
        if constexpr (Diffusion) shares.of[Dim] = (w * Vi) * (0 - dp - a.rho[j] * dphi);
        pending.take(shares, lists.shares + (j - lists.task_begin) * share_count);
      }
    }
    pending.add();
    push.add_to(a.f, i, count, 0 - norm);
    if constexpr (Diffusion)
      (-2 * a.delta * norm * hi * spread / Pack::load(a.c + i, count)).store(a.diffusion + i, count);
  }
}

template <class Kernel, int Dim, bool UniformH>
PairLoop rates_of(const RatesChoice& c) {
  if (c.viscous)
    return c.gradient ? &rates<Kernel, Dim, UniformH, true, true>
                      : &rates<Kernel, Dim, UniformH, true, false>;
  return c.gradient ? &rates<Kernel, Dim, UniformH, false, true>
                    : &rates<Kernel, Dim, UniformH, false, false>;
}
template <class Kernel>
PairLoop rates_of(const RatesChoice& c) {
  if (c.dim == 2) return c.uniform_h ? rates_of<Kernel, 2, true>(c) : rates_of<Kernel, 2, false>(c);
  return c.uniform_h ? rates_of<Kernel, 3, true>(c) : rates_of<Kernel, 3, false>(c);
}

template <class Kernel, int Dim, bool Stress, bool Diffusion>
PairLoop forces_of(const ForcesChoice& c) {
  if (!c.uniform_h) return &forces<Kernel, Dim, false, Stress, Diffusion, Geometry::compute>;
  return c.geometry == Geometry::load ? &forces<Kernel, Dim, true, Stress, Diffusion, Geometry::load>
                                      : &forces<Kernel, Dim, true, Stress, Diffusion, Geometry::compute>;
}
template <class Kernel, int Dim>
PairLoop forces_of(const ForcesChoice& c) {
  if (c.diffusion)
    return c.stress ? forces_of<Kernel, Dim, true, true>(c) : forces_of<Kernel, Dim, false, true>(c);
  return c.stress ? forces_of<Kernel, Dim, true, false>(c) : forces_of<Kernel, Dim, false, false>(c);
}
template <class Kernel>
PairLoop forces_of(const ForcesChoice& c) {
  return c.dim == 2 ? forces_of<Kernel, 2>(c) : forces_of<Kernel, 3>(c);
}

template <class Kernel, int Dim>
void fix(const PairArrays& a, const FrozenLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  const Real hinv = 1 / a.h0, twice_q2 = 2 * a.q2;
  const Pack tiny = Pack::of(tiny_distance2 * a.h0 * a.h0), eta2 = Pack::of(0.01 * a.h0 * a.h0);
  // |G|/r below which G is rounded to 0 anywhere within 3 h, so that it does not matter what D is
  const Pack least = Pack::of(1e-3 * hinv);
  Index kept = 0;
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    const Positions<Dim> xi(a.x, i, count), vi(a.v, i, count);
    const Pack mi = Pack::load(a.m + i, count), rhoi = mi / Pack::load(a.V + i, count);
    const Pack qci = lists.viscous ? Pack::load(a.qc + i, count) : Pack::zero();
    lists.start[g] = kept;
    for (Index k = lists.all_start[g]; k < lists.all_start[g + 1]; ++k) {
      const std::ptrdiff_t j = lists.all[k];
      Difference<Dim> d(xi, a.x, j);
      d.advance(lists.ahead, Difference<Dim>(vi, a.v, j));
      const Pack r2 = dot(d, d) + tiny, rinv = rsqrt(r2);
      const Pack shape = lists.scale * gradient_shape(kernel, r2 * rinv * hinv, rinv);
      if (!any_less(Pack::zero(), shape)) continue;
      const Difference<Dim> G = times(0 - shape, d);
      Fixed16* gradient = lists.gradients + std::ptrdiff_t(kept) * (Dim * lanes);
      G.x.narrow(gradient), G.y.narrow(gradient + lanes);
      if constexpr (Dim == 3) G.z.narrow(gradient + 2 * lanes);
      Float16* factor = lists.factors + std::ptrdiff_t(kept) * (lists.factor_count * lanes);
      if (lists.viscous) {
        // eq. 16: mu = s h/D; eq. 15: m_i m_j Pi = m_i m_j/(rho_i + rho_j) mu (Q' + 2 q2 mu), where Q' is
        // q1_i c_i + q1_j c_j
        const Pack D = max(shape, least) * (r2 + eta2);
        const Pack w = a.h0 * (mi * a.m[j]) / (D * ((rhoi + a.m[j] / a.V[j]) * lists.mV));
        ((qci + a.qc[j]) * w).narrow(factor);
        if (lists.quadratic) (twice_q2 * a.h0 / D * w).narrow(factor + lanes);
      }
      if (lists.diffusion) (a.h0 * shape).narrow(factor + (lists.factor_count - 1) * lanes);
      lists.list[kept++] = lists.all[k];
    }
    lists.start[g + 1] = kept;
  }
}

template <class Kernel>
FrozenLoop fix_of(int dim) {
  return dim == 2 ? &fix<Kernel, 2> : &fix<Kernel, 3>;
}

template <class Kernel>
PairLoops loops_of() {
  return {&rates_of<Kernel>, &forces_of<Kernel>, &fix_of<Kernel>};
}

}  // namespace courant::COURANT_SIMD
