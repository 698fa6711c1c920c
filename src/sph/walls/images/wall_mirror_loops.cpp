// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/walls/images/wall_mirror_loops.hpp"

#include "sph/kernel/kernel_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

constexpr Real nowhere = 1e30;  ///< distance of a missing wall [L]

/// Walls of the sub-domains of eight particles.
template <int Dim, int Walls>
struct EightSubDomains {
  static constexpr int most_ends = WallSubDomain::most_ends;
  Difference<Dim> n[Walls];
  int ends = 0;                                       ///< greatest number of ends
  Difference<Dim> out[most_ends], across[most_ends];  ///< directions of ends, and normals of their walls
  Pack inside[most_ends], over[most_ends];            ///< distances of the particles from ends and walls
  Pack around2[most_ends];  ///< squared distance from the end beyond which no path passes it
  Pack height[Walls];       ///< of the particles themselves
  Real without[lanes];      ///< 1: no sub-domain, or skipped

  /// `set`: determines `skipped`; else uses it.
  EightSubDomains(const WallMirrorArrays& a, Index i, Index count, Real back, bool set) {
    Real normal[Walls][3][lanes], offset[Walls][lanes];
    const WallSubDomain* of[lanes];
    for (Index l = 0; l < lanes; ++l) {
      const WallSubDomain* domain = l < count ? a.domain[i + l] : nullptr;
      if (set && l < count) a.skipped[i + l] = 0;
      if (domain && !set && a.skipped[i + l] != 0) domain = nullptr;
      if (domain && set)
        for (int k = 0; k < domain->walls; ++k) {
          Real h = -domain->offset[k];
          for (int c = 0; c < Dim; ++c)
            h += domain->n[k][c] * (a.x[c][i + l] + a.aside[c] - back * a.v[c][i + l]);
          if (!(h > 0)) a.skipped[i + l] = 1;
        }
      if (domain && set)
        for (int e = 0; e < domain->ends; ++e) {
          Real inside = domain->end[e].limit - 0.5 * a.width;
          for (int c = 0; c < Dim; ++c)
            inside -= domain->end[e].m[c] * (a.x[c][i + l] + a.aside[c] - back * a.v[c][i + l]);
          if (!(inside > 0)) a.skipped[i + l] = 1;
        }
      if (domain && set && a.skipped[i + l] != 0) domain = nullptr;
      without[l] = domain == nullptr;
      of[l] = domain;
      if (domain && ends < domain->ends) ends = domain->ends;
      for (int k = 0; k < Walls; ++k) {
        const bool has = domain && k < domain->walls;
        for (int c = 0; c < 3; ++c) normal[k][c][l] = has ? domain->n[k][c] : 0;
        offset[k][l] = has ? domain->offset[k] : -nowhere;
        for (int c = 0; has && c < Dim; ++c) offset[k][l] -= domain->n[k][c] * a.aside[c];
      }
    }
    for (int k = 0; k < Walls; ++k) {
      n[k].x = Pack::load(normal[k][0]), n[k].y = Pack::load(normal[k][1]);
      if constexpr (Dim == 3) n[k].z = Pack::load(normal[k][2]);
      height[k] = Pack::zero() - Pack::load(offset[k]);
    }
    for (int e = 0; set && e < ends; ++e) take_end(a, e, of);
  }
  COURANT_INLINE void set_heights(const Positions<Dim>& x) {
    for (int k = 0; k < Walls; ++k) height[k] += along(n[k], x);
  }
  /// The same for ends, with the range `reach`.
  COURANT_INLINE void set_ends(const Positions<Dim>& x, Real reach, Real width) {
    for (int e = 0; e < ends; ++e) {
      inside[e] -= along(out[e], x), over[e] += along(across[e], x);
      const Pack to_edge = inside[e] + 0.5 * width, off2 = to_edge * to_edge + over[e] * over[e];
      const Pack left = positive(reach + width - off2 * rsqrt(off2));
      around2[e] = left * left;
    }
  }
  /// > 0 for pairs without a path past an end.
  COURANT_INLINE Pack clear_of_ends(const Difference<Dim>& d, Real width) const {
    Pack least = Pack::of(1);
    for (int e = 0; e < ends; ++e) {
      const Pack there = inside[e] + dot(out[e], d), to_edge = there + 0.5 * width,
                 above = over[e] - dot(across[e], d);
      least = min(least, min(there, to_edge * to_edge + above * above - around2[e]));
    }
    return least;
  }

 private:
  COURANT_INLINE static Pack along(const Difference<Dim>& n, const Positions<Dim>& x) {
    const Pack two = n.x * x.x + n.y * x.y;
    if constexpr (Dim == 3) return two + n.z * x.z;
    return two;
  }
  void take_end(const WallMirrorArrays& a, int e, const WallSubDomain* const (&of)[lanes]) {
    Real m[3][lanes], normal[3][lanes], limit[lanes], offset[lanes];
    for (Index l = 0; l < lanes; ++l) {
      const WallSubDomain::End* end = of[l] && e < of[l]->ends ? &of[l]->end[e] : nullptr;
      limit[l] = end ? end->limit - 0.5 * a.width : nowhere, offset[l] = end ? end->offset : -nowhere;
      for (int c = 0; c < 3; ++c) {
        m[c][l] = end ? end->m[c] : 0, normal[c][l] = end ? end->n[c] : 0;
        if (c < Dim) limit[l] -= m[c][l] * a.aside[c], offset[l] -= normal[c][l] * a.aside[c];
      }
    }
    out[e].x = Pack::load(m[0]), out[e].y = Pack::load(m[1]);
    across[e].x = Pack::load(normal[0]), across[e].y = Pack::load(normal[1]);
    if constexpr (Dim == 3) out[e].z = Pack::load(m[2]), across[e].z = Pack::load(normal[2]);
    inside[e] = Pack::load(limit), over[e] = Pack::zero() - Pack::load(offset);
  }
};

/// Calls f(S, shape) for each set S of walls (bits) with an image of j in range.
template <int Walls, class Kernel, class F>
COURANT_INLINE void for_each_image(const Kernel& kernel, const Pack& r2, const Pack (&farther)[Walls],
                                   const Pack& reach2, Real hinv, const F& f) {
  for (int S = 1; S < 1 << Walls; ++S) {
    Pack far2 = r2;
    for (int k = 0; k < Walls; ++k)
      if (S >> k & 1) far2 += farther[k];
    if (!any_less(far2, reach2)) continue;
    const Pack rinv = rsqrt(far2);
    f(S, gradient_shape(kernel, far2 * rinv * hinv, rinv));
  }
}

template <int Walls>
COURANT_INLINE Pack least(const Pack (&of)[Walls]) {
  Pack out = of[0];
  for (int k = 1; k < Walls; ++k) out = min(out, of[k]);
  return out;
}

/// Records list entry k for lanes with j in range and `clear` not positive; returns 0 for these, 1 for
/// others.
inline Pack find_doubts(const WallMirrorArrays& a, Index k, const Pack& r2, const Pack& reach2,
                        const Pack& clear, const Real (&without)[lanes], Index count) {
  Real distance2[lanes], reach[lanes], good[lanes], keep[lanes];
  r2.store(distance2), reach2.store(reach), clear.store(good);
  unsigned doubt = 0;
  for (Index l = 0; l < lanes; ++l) {
    const bool bad = l < count && without[l] == 0 && distance2[l] < reach[l] && !(good[l] > 0);
    keep[l] = !bad;
    if (bad) doubt |= 1U << l;
  }
  if (doubt != 0) {
    a.doubt[*a.doubts] = k;
    a.doubt_lanes[(*a.doubts)++] = static_cast<unsigned char>(doubt);
  }
  return Pack::load(keep);
}
/// 0 for lanes recorded by the rates, the next of which is `at`; 1 for others.
inline Pack known_doubts(const WallMirrorArrays& a, Index k, Index& at) {
  Real keep[lanes];
  const bool any = at < *a.doubts && a.doubt[at] == k;
  for (Index l = 0; l < lanes; ++l) keep[l] = !any || (a.doubt_lanes[at] >> l & 1) == 0;
  if (any) ++at;
  return Pack::load(keep);
}

template <class Kernel, int Dim, int Walls>
void group_rates(const Kernel& kernel, const WallMirrorArrays& a, const NeighbourLists& lists, Index g,
                 Index i, Index count) {
  const Real half = a.half_step, hinv = 1 / a.h;
  const Pack reach2 = Pack::of(power<2>(kernel.support * a.h)), tiny = Pack::of(tiny_distance2 * a.h * a.h);
  EightSubDomains<Dim, Walls> domains(a, i, count, half, true);
  Positions<Dim> xi(a.x, i, count);
  const Positions<Dim> vi(a.v, i, count);
  xi.x -= half * vi.x, xi.y -= half * vi.y;
  if constexpr (Dim == 3) xi.z -= half * vi.z;
  domains.set_heights(xi);
  domains.set_ends(xi, kernel.support * a.h, a.width);
  Pack speed[Walls];  // along the normals
  for (int k = 0; k < Walls; ++k) {
    speed[k] = domains.n[k].x * vi.x + domains.n[k].y * vi.y;
    if constexpr (Dim == 3) speed[k] += domains.n[k].z * vi.z;
  }
  Pack div = Pack::zero();
  for (Index entry = lists.start[g]; entry < lists.start[g + 1]; ++entry) {
    const std::ptrdiff_t j = lists.list[entry];
    Difference<Dim> d, u(vi, a.v, j);
    d.x = xi.x - (a.x[0][j] - half * a.v[0][j]), d.y = xi.y - (a.x[1][j] - half * a.v[1][j]);
    if constexpr (Dim == 3) d.z = xi.z - (a.x[2][j] - half * a.v[2][j]);
    const Pack r2 = dot_plus(d, d, tiny);
    Pack there[Walls], farther[Walls];
    for (int k = 0; k < Walls; ++k) {
      there[k] = domains.height[k] - dot(domains.n[k], d);
      farther[k] = 4 * domains.height[k] * positive(there[k]);  // particles behind have no image
    }
    Pack volume = Pack::of(a.V[j]), clear = least<Walls>(there);
    if (domains.ends > 0) clear = min(clear, domains.clear_of_ends(d, a.width));
    if (any_less(clear, Pack::of(1e-300)))
      volume = volume * find_doubts(a, entry, r2, reach2, clear, domains.without, count);
    if (!any_less(r2 + least<Walls>(farther), reach2)) continue;
    Pack more[Walls];
    for (int k = 0; k < Walls; ++k)
      more[k] = 2 * (speed[k] * there[k] + (speed[k] - dot(domains.n[k], u)) * domains.height[k]);
    const Pack u_dot_d = dot(u, d);
    Pack change = Pack::zero();
    for_each_image<Walls>(kernel, r2, farther, reach2, hinv, [&](int S, const Pack& shape) {
      Pack along = u_dot_d;
      for (int k = 0; k < Walls; ++k)
        if (S >> k & 1) along += more[k];
      change += shape * along;
    });
    div += volume * change;
  }
  Real rate[lanes];
  (gradient_norm<Dim>(kernel, a.h) * div).store(rate);
  for (Index l = 0; l < count; ++l)
    if (domains.without[l] == 0) a.drhodt[i + l] += a.rho[i + l] * rate[l];
}

template <class Kernel, int Dim, int Walls>
void group_forces(const Kernel& kernel, const WallMirrorArrays& a, const NeighbourLists& lists, Index g,
                  Index i, Index count, Index& next_doubt) {
  const Real hinv = 1 / a.h;
  const Pack reach2 = Pack::of(power<2>(kernel.support * a.h)), tiny = Pack::of(tiny_distance2 * a.h * a.h);
  EightSubDomains<Dim, Walls> domains(a, i, count, 0, false);
  const Positions<Dim> xi(a.x, i, count);
  domains.set_heights(xi);
  const bool diffuses = a.diffusion != nullptr;
  const Pack pi = Pack::load(a.p + i, count), rho = Pack::load(a.rho + i, count),
             phi = diffuses ? Pack::load(a.potential + i, count) : Pack::zero();
  Sum<Dim> force;
  Pack across[Walls], diffusion = Pack::zero();
  for (int k = 0; k < Walls; ++k) across[k] = Pack::zero();
  for (Index entry = lists.start[g]; entry < lists.start[g + 1]; ++entry) {
    const std::ptrdiff_t j = lists.list[entry];
    Pack volume = Pack::of(a.V[j]);
    if (next_doubt < *a.doubts && a.doubt[next_doubt] == entry)
      volume = volume * known_doubts(a, entry, next_doubt);
    const Difference<Dim> d(xi, a.x, j);
    const Pack r2 = dot_plus(d, d, tiny);
    Pack there[Walls], farther[Walls];
    for (int k = 0; k < Walls; ++k) {
      there[k] = domains.height[k] - dot(domains.n[k], d);
      farther[k] = 4 * domains.height[k] * positive(there[k]);  // particles behind have no image
    }
    if (!any_less(r2 + least<Walls>(farther), reach2)) continue;
    Pack all = Pack::zero(), by[Walls];
    for (int k = 0; k < Walls; ++k) by[k] = Pack::zero();
    for_each_image<Walls>(kernel, r2, farther, reach2, hinv, [&](int S, const Pack& shape) {
      all += shape;
      for (int k = 0; k < Walls; ++k)
        if (S >> k & 1) by[k] += shape;
    });
    const Pack pressure = volume * (pi + a.p[j]);
    force.add(pressure * all, d);
    for (int k = 0; k < Walls; ++k) across[k] += 2 * pressure * there[k] * by[k];
    if (diffuses) diffusion += volume * all * (a.p[j] - pi + rho * (a.potential[j] - phi));
  }
  for (int k = 0; k < Walls; ++k) force.add(across[k], domains.n[k]);
  const Pack factor = (0 - gradient_norm<Dim>(kernel, a.h)) * Pack::load(a.V + i, count);
  Real of[4][lanes];
  (factor * force.x).store(of[0]), (factor * force.y).store(of[1]), (factor * force.z).store(of[2]);
  (-2 * a.delta * a.h * gradient_norm<Dim>(kernel, a.h) * diffusion).store(of[3]);
  for (Index l = 0; l < count; ++l) {
    if (domains.without[l] != 0) continue;
    for (int c = 0; c < Dim; ++c) a.f[c][i + l] += of[c][l], a.wall_force[c][i + l] = of[c][l];
    if (diffuses) a.diffusion[i + l] += of[3][l] / a.c[i + l];
  }
}

/// Calls the loop for the greatest number of walls in each group of eight.
template <class Kernel, int Dim, bool Rates>
void loop(const WallMirrorArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  Index next_doubt = 0;
  if (Rates) *a.doubts = 0;
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    int walls = 0;
    for (Index l = 0; l < count; ++l)
      if (const WallSubDomain* domain = a.domain[i + l])
        walls = walls < domain->walls ? domain->walls : walls;
    if (walls == 0) continue;
    if constexpr (Rates) {
      if (walls == 1) group_rates<Kernel, Dim, 1>(kernel, a, lists, g, i, count);
      if (walls == 2) group_rates<Kernel, Dim, 2>(kernel, a, lists, g, i, count);
      if (Dim == 3 && walls == 3) group_rates<Kernel, Dim, 3>(kernel, a, lists, g, i, count);
    } else {
      if (walls == 1) group_forces<Kernel, Dim, 1>(kernel, a, lists, g, i, count, next_doubt);
      if (walls == 2) group_forces<Kernel, Dim, 2>(kernel, a, lists, g, i, count, next_doubt);
      if (Dim == 3 && walls == 3) group_forces<Kernel, Dim, 3>(kernel, a, lists, g, i, count, next_doubt);
    }
  }
}

}  // namespace

WallMirrorLoop mirror_rates_loop(KernelChoice choice, int dim) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> WallMirrorLoop {
    return dim == 2 ? &loop<Kernel, 2, true> : &loop<Kernel, 3, true>;
  });
}
WallMirrorLoop mirror_forces_loop(KernelChoice choice, int dim) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> WallMirrorLoop {
    return dim == 2 ? &loop<Kernel, 2, false> : &loop<Kernel, 3, false>;
  });
}

}  // namespace courant::COURANT_SIMD
