// Compiled once for each instruction set; see docs/architecture.md.
#include "sph/walls/wall_edge_loops.hpp"

#include "sph/kernel/kernel_packs.hpp"

namespace courant::COURANT_SIMD {

namespace {

constexpr Real nowhere = 1e30;  ///< distance of a missing edge [L]

/// 1 where a > 0, else 0.
COURANT_INLINE Pack is_positive(const Pack& a) {
  Pack out;
  const Native one = 1 - Native{}, none{};
  for (int k = 0; k < parts; ++k) out.part[k] = a.part[k] > none ? one : none;
  return out;
}

/// Passage of a path by an edge, in the plane normal to the edge.
struct Passing {
  Pack share;       ///< of the path that the wall takes
  Pack by_start;    ///< derivative of the share with respect to the start of the path [1/L]
  Pack by_end;      ///< the same for its end
  Pack over, into;  ///< direction of these derivatives, along n and m
  Pack bends;       ///< > 0 where the share is partial
};

/// The path from (h, e) to (h_to, e_to): heights over the wall's plane and distances from the edge into
/// the wall.
COURANT_INLINE Passing pass(const Pack& h, const Pack& e, const Pack& h_to, const Pack& e_to,
                            const Pack& meets, const Pack& free, Real width, const Pack& tiny) {
  const Pack dh = h_to - h, de = e_to - e;
  // the middle of a path parallel to the edge, which has a constant distance
  const Pack part =
      min(max((0.5 * tiny - (h * dh + e * de)) / (dh * dh + de * de + tiny), Pack::zero()), Pack::of(1));
  const Pack over = h + part * dh, into = e + part * de, r2 = over * over + into * into + tiny,
             rinv = rsqrt(r2);
  const Pack side = (2 * meets - 1) * (1 / width), near = min(r2 * rinv, Pack::of(0.5 * width)),
             t = 0.5 + side * near, steep = free * (6 * t * (1 - t) * side);
  return {free * (t * t * (3 - 2 * t)),
          (1 - part) * steep,
          part * steep,
          over * rinv,
          into * rinv,
          free * (Pack::of(0.25 * width * width) - r2)};
}

/// Walls at the edges of eight particles.
template <int Dim>
struct EightEdges {
  Difference<Dim> n[2], m[2];
  Pack height[2], inward[2];  ///< of the particles themselves
  Difference<Dim> v, spin;    ///< of the body at the particles; in 2D spin.z alone
  bool move = false;          ///< any of the edges moves
  Real moves[lanes];          ///< 1: its edge moves
  Real without[lanes];        ///< 1: no edge, or skipped

  /// `set`: determines `skipped`; else uses it.
  EightEdges(const WallMirrorArrays& a, Index i, Index count, Real back, bool set) {
    Real axis[4][3][lanes], offset[4][lanes], rate[2][3][lanes];
    for (Index l = 0; l < lanes; ++l) {
      const WallEdge* edge = l < count ? a.edge[i + l] : nullptr;
      if (edge && set) a.skipped[i + l] = is_skipped(a, *edge, i + l, back);
      if (edge && a.skipped[i + l] != 0) edge = nullptr;
      without[l] = edge == nullptr, moves[l] = edge && edge->moves;
      move = move || moves[l] > 0;
      for (int c = 0; c < 3; ++c) {
        rate[1][c][l] = edge ? edge->spin[c] : 0, rate[0][c][l] = edge ? edge->v[c] : 0;
        // at the particle; in 2D spin is normal to the plane
        const int next = (c + 1) % 3, last = (c + 2) % 3;
        const auto off = [&](int k) {
          return set && edge && k < Dim ? a.x[k][i + l] + a.aside[k] - back * a.v[k][i + l] - edge->at[k] : 0;
        };
        if (edge) rate[0][c][l] += edge->spin[next] * off(last) - edge->spin[last] * off(next);
      }
      for (int k = 0; k < 4; ++k) {  // n and m of the first wall, then of the second one
        const Real* of = !edge || k / 2 >= edge->walls ? nullptr
                         : k % 2 == 0                  ? edge->n[k / 2]
                                                       : edge->m[k / 2];
        offset[k][l] = of || k % 2 == 1 ? 0 : -nowhere;
        for (int c = 0; c < 3; ++c) axis[k][c][l] = of ? of[c] : 0;
        for (int c = 0; of && c < Dim; ++c) offset[k][l] += of[c] * (edge->at[c] - a.aside[c]);
      }
    }
    for (int k = 0; k < 2; ++k) {
      take(n[k], axis[2 * k]), take(m[k], axis[2 * k + 1]);
      height[k] = Pack::zero() - Pack::load(offset[2 * k]);
      inward[k] = Pack::zero() - Pack::load(offset[2 * k + 1]);
    }
    take(v, rate[0]), take(spin, rate[1]);
    spin.z = Pack::load(rate[1][2]);
  }
  /// Subtracts the difference of the body velocities at the ends of d.
  COURANT_INLINE void take_off(Difference<Dim>& u, const Difference<Dim>& d) const {
    u.x += spin.z * d.y, u.y -= spin.z * d.x;
    if constexpr (Dim == 3) {
      u.x -= spin.y * d.z, u.y += spin.x * d.z;
      u.z += spin.y * d.x - spin.x * d.y;
    }
  }
  COURANT_INLINE void set_heights(const Positions<Dim>& x) {
    for (int k = 0; k < 2; ++k) height[k] += along(n[k], x), inward[k] += along(m[k], x);
  }
  COURANT_INLINE static Pack along(const Difference<Dim>& n, const Positions<Dim>& x) {
    const Pack two = n.x * x.x + n.y * x.y;
    if constexpr (Dim == 3) return two + n.z * x.z;
    return two;
  }

 private:
  /// Whether the particle is inside the corner that two walls enclose.
  static bool is_skipped(const WallMirrorArrays& a, const WallEdge& edge, Index i, Real back) {
    bool behind = edge.walls == 2;
    for (int k = 0; k < edge.walls; ++k) {
      Real h = 0;
      for (int c = 0; c < Dim; ++c)
        h += edge.n[k][c] * (a.x[c][i] + a.aside[c] - back * a.v[c][i] - edge.at[c]);
      behind = behind && !(h > 0);
    }
    return behind;
  }
  static void take(Difference<Dim>& to, const Real (&from)[3][lanes]) {
    to.x = Pack::load(from[0]), to.y = Pack::load(from[1]);
    if constexpr (Dim == 3) to.z = Pack::load(from[2]);
  }
};

/// Paths of a pair beside an edge.
template <int Dim>
struct EdgePaths {
  Pack there[2];            ///< height of j
  Passing straight, by[2];  ///< hidden part of the straight path; reflection by each wall
  Pack inward[2];           ///< of j
  COURANT_INLINE EdgePaths(const EightEdges<Dim>& edges, const Difference<Dim>& d, Real width,
                           const Pack& tiny) {
    Pack hides[2];
    for (int k = 0; k < 2; ++k) {
      there[k] = edges.height[k] - dot(edges.n[k], d);
      inward[k] = edges.inward[k] - dot(edges.m[k], d);
    }
    // no path passes the edge to a particle inside the corner
    const Pack free = is_positive(max(there[0], there[1]));
    for (int k = 0; k < 2; ++k) {
      const Pack &h = edges.height[k], &e = edges.inward[k];
      const Pack across = inward[k] * h, back = e * there[k];
      hides[k] = is_positive(min(0 - h * there[k], (across - back) * h));
      by[k] = pass(h, e, 0 - there[k], inward[k], is_positive(min(h * there[k], (across + back) * h)), free,
                   width, tiny);
    }
    straight = pass(edges.height[0], edges.inward[0], there[0], inward[0], max(hides[0], hides[1]), free,
                    width, tiny);
    straight.share += 1 - free;
  }
  /// 1 where i and j are on different sides of the plane of a wall, else 0.
  COURANT_INLINE Pack across(const EightEdges<Dim>& edges) const {
    return is_positive(max(0 - edges.height[0] * there[0], 0 - edges.height[1] * there[1]));
  }
  /// Squared distance of i from the image of j behind a wall.
  COURANT_INLINE Pack far2(const EightEdges<Dim>& edges, int k, const Pack& r2, const Pack& tiny) const {
    return max(r2 + 4 * edges.height[k] * there[k], tiny);
  }
  /// Bits of WallMirrorArrays::edge_paths.
  COURANT_INLINE std::uint32_t note(const EightEdges<Dim>& edges, const Pack& r2, const Pack& reach2,
                                    const Pack& tiny) const {
    const Pack other = r2 - 2 * tiny;
    Pack bends = min(straight.bends, other);
    Real within[lanes], over[lanes], seen[3][lanes];
    for (int k = 0; k < 2; ++k) {
      const Pack near = reach2 - far2(edges, k, r2, tiny);
      bends = max(bends, min(by[k].bends, near)), min(by[k].share - 0.5, near).store(seen[k]);
    }
    min(straight.share - 0.5, other).store(seen[2]), (reach2 - r2).store(within), bends.store(over);
    std::uint32_t out = 0;
    for (Index l = 0; l < lanes; ++l) {
      if (!(edges.moves[l] > 0) || !(within[l] > 0)) continue;
      if (over[l] > 0) out |= 1U << 4 * l;
      for (int k = 0; k < 3 && !(over[l] > 0); ++k)
        if (seen[k][l] > 0) out |= 2U << k << 4 * l;
    }
    return out;
  }
};

/// Paths of a pair that enter the forces.
struct Counted {
  Pack now;      ///< 1: at the end of the step, 0: as in the middle of the step
  Pack seen[3];  ///< in that case 1 for each path found: by each wall, and hidden
  template <int Dim>
  Counted(const EightEdges<Dim>& edges, std::uint32_t known, const Pack& near) : now(near) {
    for (int k = 0; k < 3; ++k) seen[k] = Pack::zero();
    if (!edges.move) return;
    Real as_now[lanes], as_then[3][lanes];
    for (Index l = 0; l < lanes; ++l) {
      const std::uint32_t bits = known >> 4 * l;
      as_now[l] = !(edges.moves[l] > 0) || (bits & 1U) != 0;
      for (int k = 0; k < 3; ++k) as_then[k][l] = (bits >> (k + 1) & 1U) != 0;
    }
    now = now * Pack::load(as_now);
    for (int k = 0; k < 3; ++k) seen[k] = Pack::load(as_then[k]);
  }
  COURANT_INLINE Passing of(const Passing& ray, int k) const {
    Passing out = ray;
    out.share = now * ray.share + seen[k], out.by_start = now * ray.by_start, out.by_end = now * ray.by_end;
    return out;
  }
};

/// Reactions of paths on a moving edge and its walls (WallEdgeReaction), without the volume of i.
template <int Dim>
struct EightReactions {
  Pack push[2], inward[2], along[2], edge[2][2], edge_along[2][2];
  Difference<Dim> axis;  ///< the edge's direction
  explicit EightReactions(const EightEdges<Dim>& edges) {
    for (int k = 0; k < 2; ++k) {
      push[k] = inward[k] = along[k] = Pack::zero();
      for (int c = 0; c < 2; ++c) edge[k][c] = edge_along[k][c] = Pack::zero();
    }
    const Difference<Dim>&n = edges.n[0], &m = edges.m[0];
    axis.x = axis.y = axis.z = Pack::zero();
    if constexpr (Dim == 3) {
      axis.x = n.y * m.z - n.z * m.y, axis.y = n.z * m.x - n.x * m.z;
      axis.z = n.x * m.y - n.y * m.x;
    }
  }
  /// `slope`: force on i is slope times d; `share`: factor of the gradient of the share.
  COURANT_INLINE void add_image(const EightEdges<Dim>& edges, const EdgePaths<Dim>& paths, int k,
                                const Passing& ray, const Difference<Dim>& d, const Pack& slope,
                                const Pack& share) {
    const Pack &h = edges.height[k], &there = paths.there[k];
    const Pack to_j = paths.inward[k] - edges.inward[k], turned = share * ray.by_end, z = 0 - dot(axis, d);
    push[k] += turned * ray.over - slope * (h + there);
    inward[k] += turned * (ray.over * to_j + there * ray.into) - slope * h * to_j;
    along[k] += (turned * ray.over - slope * h) * z;
    add_edge(k, ray, Pack::of(-0.5) * share, z);
  }
  COURANT_INLINE void add_edge(int k, const Passing& ray, const Pack& share, const Pack& z) {
    const Pack both = share * (ray.by_start + ray.by_end), at_end = share * ray.by_end * z;
    edge[k][0] += both * ray.over, edge[k][1] += both * ray.into;
    edge_along[k][0] += at_end * ray.over, edge_along[k][1] += at_end * ray.into;
  }
  void give(const EightEdges<Dim>& edges, const Pack& factor, WallEdgeReaction* to, Index count) const {
    Real of[14][lanes];
    for (int k = 0; k < 2; ++k) {
      (factor * push[k]).store(of[k]), (factor * inward[k]).store(of[2 + k]);
      (factor * along[k]).store(of[4 + k]);
      for (int c = 0; c < 2; ++c) {
        (factor * edge[k][c]).store(of[6 + 2 * k + c]);
        (factor * edge_along[k][c]).store(of[10 + 2 * k + c]);
      }
    }
    for (Index l = 0; l < count; ++l) {
      if (!(edges.moves[l] > 0)) continue;
      for (int k = 0; k < 2; ++k) {
        to[l].push[k] = of[k][l], to[l].inward[k] = of[2 + k][l], to[l].along[k] = of[4 + k][l];
        for (int c = 0; c < 2; ++c)
          to[l].edge[k][c] = of[6 + 2 * k + c][l], to[l].edge_along[k][c] = of[10 + 2 * k + c][l];
      }
    }
  }
};

template <class Kernel, int Dim>
void group_rates(const Kernel& kernel, const WallMirrorArrays& a, const NeighbourLists& lists, Index g,
                 Index i, Index count) {
  const Real half = a.half_step, hinv = 1 / a.h;
  const Pack reach2 = Pack::of(power<2>(kernel.support * a.h)), tiny = Pack::of(tiny_distance2 * a.h * a.h);
  const Real slope_norm = gradient_norm<Dim>(kernel, a.h), norm = shape_norm<Dim>(kernel, a.h);
  EightEdges<Dim> edges(a, i, count, half, true);
  Positions<Dim> xi(a.x, i, count);
  const Positions<Dim> vi(a.v, i, count);
  xi.x -= half * vi.x, xi.y -= half * vi.y;
  if constexpr (Dim == 3) xi.z -= half * vi.z;
  edges.set_heights(xi);
  Pack speed[2], inward_speed[2];  // relative to the body
  for (int k = 0; k < 2; ++k) {
    speed[k] = edges.along(edges.n[k], vi) - dot(edges.n[k], edges.v);
    inward_speed[k] = edges.along(edges.m[k], vi) - dot(edges.m[k], edges.v);
  }
  const Pack kept = 1 - Pack::load(a.edge_loss + i, count);
  Pack div = Pack::zero(), passing[2] = {Pack::zero(), Pack::zero()};
  for (Index entry = lists.start[g]; entry < lists.start[g + 1]; ++entry) {
    const std::ptrdiff_t j = lists.list[entry];
    Difference<Dim> d, u(vi, a.v, j);
    d.x = xi.x - (a.x[0][j] - half * a.v[0][j]), d.y = xi.y - (a.x[1][j] - half * a.v[1][j]);
    if constexpr (Dim == 3) d.z = xi.z - (a.x[2][j] - half * a.v[2][j]);
    const Pack r2 = dot_plus(d, d, tiny);
    if (edges.move) a.edge_paths[entry] = 0;
    if (!any_less(r2, reach2)) continue;  // such pairs have no paths in range
    if (edges.move) edges.take_off(u, d);
    const EdgePaths<Dim> paths(edges, d, a.width, tiny);
    if (edges.move) a.edge_paths[entry] = paths.note(edges, r2, reach2, tiny);
    const Pack u_dot_d = dot(u, d);
    Pack change = Pack::zero();
    const Pack within = a.V[j] * is_positive(reach2 - r2);
    const auto add = [&](const Passing& ray, const Pack& far2, const Pack& along, const Pack& share_rate,
                         const Pack& exists, int kind) {
      const Pack rinv = rsqrt(far2), R = far2 * rinv * hinv, W = norm * kernel.shape(R);
      change += slope_norm * ray.share * gradient_shape(kernel, R, rinv) * along +
                kept * (1 - a.edge_loss[j]) * W * share_rate;
      passing[kind] += within * exists * W * max(ray.by_start, 0 - ray.by_start);
    };
    for (int k = 0; k < 2; ++k) {
      const Passing& ray = paths.by[k];
      if (!any_less(Pack::zero(), ray.share)) continue;
      const Pack of_j = speed[k] - dot(edges.n[k], u), inward_of_j = inward_speed[k] - dot(edges.m[k], u);
      add(ray, paths.far2(edges, k, r2, tiny),
          u_dot_d + 2 * (speed[k] * paths.there[k] + of_j * edges.height[k]),
          ray.by_start * (ray.over * speed[k] + ray.into * inward_speed[k]) +
              ray.by_end * (ray.into * inward_of_j - ray.over * of_j),
          Pack::of(1), 0);
    }
    const Passing& ray = paths.straight;
    if (any_less(Pack::zero(), ray.share)) {
      const Pack reflected = change;
      const Pack of_j = speed[0] - dot(edges.n[0], u), inward_of_j = inward_speed[0] - dot(edges.m[0], u);
      const Pack other = is_positive(r2 - 2 * tiny);  // a particle has no straight path to itself
      change = Pack::zero();
      add(ray, r2, u_dot_d,
          ray.by_start * (ray.over * speed[0] + ray.into * inward_speed[0]) +
              ray.by_end * (ray.over * of_j + ray.into * inward_of_j),
          other * paths.across(edges), 1);
      change = reflected - other * change;
    }
    div += within * change;
  }
  Real rate[lanes], sum[2][lanes];
  div.store(rate), passing[0].store(sum[0]), passing[1].store(sum[1]);
  for (Index l = 0; l < count; ++l) {
    if (edges.without[l] != 0) continue;
    a.drhodt[i + l] += a.rho[i + l] * rate[l];
    for (int k = 0; k < 2; ++k) a.edge_sum[k][i + l] += sum[k][l];
  }
}

/// Adds the contributions of paths to particles; the hidden part is subtracted and is not a wall force.
template <int Dim>
void give_forces(const WallMirrorArrays& a, const EightEdges<Dim>& edges, Index i, Index count,
                 const Pack& factor, const Sum<Dim>& force, const Sum<Dim>& hidden, const Pack& diffusion) {
  Real of[3][lanes], taken[3][lanes], of_diffusion[lanes];
  (factor * force.x).store(of[0]), (factor * force.y).store(of[1]), (factor * force.z).store(of[2]);
  (factor * hidden.x).store(taken[0]), (factor * hidden.y).store(taken[1]);
  (factor * hidden.z).store(taken[2]);
  diffusion.store(of_diffusion);
  for (Index l = 0; l < count; ++l) {
    if (edges.without[l] != 0) continue;
    for (int c = 0; c < Dim; ++c) {
      a.f[c][i + l] += of[c][l] - taken[c][l];
      a.wall_force[c][i + l] = of[c][l];
    }
    if (a.diffusion) a.diffusion[i + l] += of_diffusion[l] / a.c[i + l];
  }
}

template <class Kernel, int Dim>
void group_forces(const Kernel& kernel, const WallMirrorArrays& a, const NeighbourLists& lists, Index g,
                  Index i, Index count) {
  const Real hinv = 1 / a.h;
  const Pack reach2 = Pack::of(power<2>(kernel.support * a.h)), tiny = Pack::of(tiny_distance2 * a.h * a.h);
  const Real slope_norm = gradient_norm<Dim>(kernel, a.h), norm = shape_norm<Dim>(kernel, a.h);
  EightEdges<Dim> edges(a, i, count, 0, false);
  const Positions<Dim> xi(a.x, i, count);
  edges.set_heights(xi);
  const bool diffuses = a.diffusion != nullptr;
  const Pack pi = Pack::load(a.p + i, count), rho = Pack::load(a.rho + i, count),
             phi = diffuses ? Pack::load(a.potential + i, count) : Pack::zero();
  Sum<Dim> force, hidden;
  Pack over[2] = {Pack::zero(), Pack::zero()}, into[2] = {Pack::zero(), Pack::zero()},
       diffusion = Pack::zero();
  EightReactions<Dim> reactions(edges);
  const Pack kept = 1 - Pack::load(a.edge_loss + i, count);
  for (Index entry = lists.start[g]; entry < lists.start[g + 1]; ++entry) {
    const std::ptrdiff_t j = lists.list[entry];
    const Difference<Dim> d(xi, a.x, j);
    const Pack r2 = dot_plus(d, d, tiny);
    const std::uint32_t known = edges.move ? a.edge_paths[entry] : 0;
    if (known == 0 && !any_less(r2, reach2)) continue;
    const EdgePaths<Dim> paths(edges, d, a.width, tiny);
    const Counted counted(edges, known, is_positive(reach2 - r2));
    const Pack volume = Pack::of(a.V[j]), pressure = volume * (pi + a.p[j]);
    Pack all = Pack::zero();
    for (int k = 0; k < 2; ++k) {
      const Passing ray = counted.of(paths.by[k], k);
      if (!any_less(Pack::zero(), ray.share)) continue;
      const Pack far2 = paths.far2(edges, k, r2, tiny), rinv = rsqrt(far2), R = far2 * rinv * hinv,
                 slope = slope_norm * ray.share * gradient_shape(kernel, R, rinv),
                 share = kept * (1 - a.edge_loss[j]) * norm * kernel.shape(R),
                 share_slope = share * ray.by_start;
      force.add(pressure * slope, d);
      over[k] += pressure * (2 * slope * paths.there[k] + share_slope * ray.over);
      into[k] += pressure * share_slope * ray.into;
      all += slope;
      if (edges.move) reactions.add_image(edges, paths, k, ray, d, pressure * slope, pressure * share);
    }
    const Passing ray = counted.of(paths.straight, 2);
    if (any_less(Pack::zero(), ray.share)) {
      const Pack rinv = rsqrt(r2), R = r2 * rinv * hinv, other = is_positive(r2 - 2 * tiny),
                 slope = other * (slope_norm * ray.share * gradient_shape(kernel, R, rinv)),
                 share = kept * (1 - a.edge_loss[j]) * other * (norm * kernel.shape(R)),
                 share_slope = share * ray.by_start;
      hidden.add(pressure * slope, d);
      over[0] -= pressure * share_slope * ray.over, into[0] -= pressure * share_slope * ray.into;
      all -= slope;
      if (edges.move) reactions.add_edge(0, ray, 0.5 * pressure * share, 0 - dot(reactions.axis, d));
    }
    if (diffuses) diffusion += volume * all * (a.p[j] - pi + rho * (a.potential[j] - phi));
  }
  for (int k = 0; k < 2; ++k) force.add(over[k], edges.n[k]), force.add(into[k], edges.m[k]);
  const Pack factor = 0 - Pack::load(a.V + i, count);
  if (edges.move) reactions.give(edges, factor, a.reaction + (i - lists.begin), count);
  give_forces(a, edges, i, count, factor, force, hidden, -2 * a.delta * a.h * diffusion);
}

/// Calls the loop for groups of eight with an edge.
template <class Kernel, int Dim, bool Rates>
void loop(const WallMirrorArrays& a, const NeighbourLists& lists) {
  const Kernel kernel = kernel_of<Kernel>(a.kernel);
  for (Index i = lists.begin, g = 0; i < lists.end; i += lanes, ++g) {
    const Index count = lists.end - i < lanes ? lists.end - i : lanes;
    bool any = false;
    for (Index l = 0; l < count; ++l) any = any || a.edge[i + l] != nullptr;
    if (!any) continue;
    if constexpr (Rates)
      group_rates<Kernel, Dim>(kernel, a, lists, g, i, count);
    else
      group_forces<Kernel, Dim>(kernel, a, lists, g, i, count);
  }
}

}  // namespace

WallMirrorLoop edge_rates_loop(KernelChoice choice, int dim) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> WallMirrorLoop {
    return dim == 2 ? &loop<Kernel, 2, true> : &loop<Kernel, 3, true>;
  });
}
WallMirrorLoop edge_forces_loop(KernelChoice choice, int dim) {
  return with_loop_kernel(choice, [&]<class Kernel>(std::type_identity<Kernel>) -> WallMirrorLoop {
    return dim == 2 ? &loop<Kernel, 2, false> : &loop<Kernel, 3, false>;
  });
}

}  // namespace courant::COURANT_SIMD
