#pragma once
// What the loops of all shells have alike, for the files that are compiled once for each instruction set. A
// register holds as many elements as it has space for; what is behind the last element of a block repeats
// that one and is not stored.
#include "elements/native_math.hpp"
#include "elements/shell/shell_loops.hpp"

namespace courant::COURANT_SIMD {

constexpr int quad = 4;

COURANT_INLINE void add_to(Real* p, Native a, Index n) {
  store(p, load(p, n) + a, n);
}
COURANT_INLINE Triple unit(const Triple& a) {
  return (1.0 / root(dot(a, a))) * a;
}

/// The axes of an element, and its differences in them.
struct Flat {
  Triple e1, e2, e3;
  Native x0, y0, x1, y1, hx, hy;
  Native A, inverse_A;
};
template <int corners>
COURANT_INLINE Flat flat_of(const Triple d[3], bool invariant) {
  Flat out;
  const Triple n = cross(d[0], d[1]);
  const Native twice = root(dot(n, n));
  out.e3 = (1.0 / twice) * n;
  if (corners != quad) {
    out.e1 = unit(d[0]);
  } else if (invariant) {  // 45 degrees before the bisector of the lines through the middles of the sides
    constexpr Real half_root = 0.70710678118654752;
    const Triple a = unit(unit(d[1] - d[0]) - unit(d[0] + d[1]));
    out.e1 = half_root * (a - cross(out.e3, a));
  } else {  // along side 1-2
    const Triple side = d[1] - d[0] - d[2];
    out.e1 = unit(side - dot(side, out.e3) * out.e3);
  }
  out.e2 = cross(out.e3, out.e1);
  out.x0 = dot(d[0], out.e1), out.y0 = dot(d[0], out.e2);
  out.x1 = dot(d[1], out.e1), out.y1 = dot(d[1], out.e2);
  if (corners == quad) out.hx = dot(d[2], out.e1), out.hy = dot(d[2], out.e2);
  out.A = 0.5 * twice, out.inverse_A = 2.0 / twice;
  return out;
}

/// A times the slopes of a nodal value with these differences.
struct Slopes {
  Native x, y;
};
COURANT_INLINE Slopes slopes(const Flat& f, Native v0, Native v1) {
  return {0.5 * (f.y1 * v0 - f.y0 * v1), 0.5 * (f.x0 * v1 - f.x1 * v0)};
}
/// The transpose: what a force P per slope x and R per slope y is along the differences.
struct SideForces {
  Native d0, d1;
};
COURANT_INLINE SideForces along(const Flat& f, Native P, Native R) {
  return {0.5 * (f.y1 * P - f.x1 * R), 0.5 * (f.x0 * R - f.y0 * P)};
}

template <int corners>
COURANT_INLINE void gather_corners(const ShellMesh& mesh, Index first, Index n, Triple x[corners],
                                   Triple v[corners], Triple w[corners]) {
  Index last[corners][native_lanes];
  for (int c = 0; c < corners; ++c) {
    const Index* nodes = mesh.corner[c] + first;
    if (n < native_lanes) {
      for (Index l = 0; l < native_lanes; ++l) last[c][l] = nodes[l < n ? l : n - 1];
      nodes = last[c];
    }
    x[c] = {gather(mesh.x[0], nodes), gather(mesh.x[1], nodes), gather(mesh.x[2], nodes)};
    v[c] = {gather(mesh.v[0], nodes), gather(mesh.v[1], nodes), gather(mesh.v[2], nodes)};
    w[c] = {gather(mesh.w[0], nodes), gather(mesh.w[1], nodes), gather(mesh.w[2], nodes)};
  }
}
template <int corners>
COURANT_INLINE void differences(const Triple p[corners], Triple d[3]) {
  if (corners == quad) {
    const Triple a = p[0] + p[2], b = p[1] + p[corners - 1];
    d[0] = p[0] - p[2], d[1] = p[1] - p[corners - 1], d[2] = a - b;
  } else {
    d[0] = p[1] - p[0], d[1] = p[2] - p[0];
  }
}

/// The length of ISDO over the speed that belongs to it, without viscosity: squares of both.
struct Length {
  Native l, c2;
};
template <int corners>
COURANT_INLINE Length length_of(const Triple d[3], const Flat& f, const ShellControl& control, Native rho) {
  Native longest, shortest;
  if (corners == quad) {
    const Triple a = d[0] + d[1], b = d[1] - d[0];
    const Triple side[4] = {b - d[2], d[2] - a, b + d[2], d[2] + a};  // twice the sides
    longest = shortest = 0.25 * dot(side[0], side[0]);
    for (int m = 1; m < 4; ++m) {
      const Native l2 = 0.25 * dot(side[m], side[m]);
      longest = native_max(longest, l2), shortest = native_min(shortest, l2);
    }
    if (control.length_rule == 1) longest = native_max(dot(d[0], d[0]), dot(d[1], d[1]));
  } else {
    const Triple side = d[1] - d[0];
    const Native a = dot(d[0], d[0]), b = dot(d[1], d[1]), c = dot(side, side);
    longest = native_max(a, native_max(b, c)), shortest = native_min(a, native_min(b, c));
  }
  // a mesh of right triangles is unstable at 0.9 of 2 A over the longest side, and stable at 0.8
  constexpr Real of_triangles = 2 * 0.85;
  const Native wide = (corners == quad ? 1.0 : of_triangles) * f.A / root(longest);
  if (control.length_rule != 2) return {wide, control.plate_modulus / rho};
  return {native_max(root(shortest), wide), control.E / rho};
}

COURANT_INLINE void store_vector(Real (*p)[block_size], Index k, const Triple& a) {
  store(p[0] + k, a.x), store(p[1] + k, a.y), store(p[2] + k, a.z);
}

/// Height of a point over the nodes. [L]
inline void heights_at(const ShellLoops::Block& block, int point, const ShellState& state, Real* z) {
  const Real half = 0.5 * state.zeta[point];
  const Real* t = state.thickness + block.begin;
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) z[i] = half * t[i];
  if (!state.offset) return;
  const Real* offset = state.offset + block.begin;
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) z[i] += 0.5 * offset[i] * t[i];
}

/// N, M and Q of position q of `places` in the plane.
COURANT_INLINE void resultants_of(Index first, Index n, int q, int places, Real factor, Native t,
                                  const ShellState& state, Native R[8]) {
  for (int m = 0; m < 8; ++m) R[m] = all(0);
  const int layers = state.points / places, begin = q * layers, end = begin + layers;
  const Native half = 0.5 * t, offset = state.offset ? load(state.offset + first, n) : all(0);
  for (int p = begin; p < end; ++p) {
    const Real* const* stress = state.stress + 6 * p;
    const Native w = (places * state.share[p]) * t, arm = (state.zeta[p] + offset) * half;
    const Native xx = w * load(stress[0] + first, n), yy = w * load(stress[1] + first, n),
                 xy = w * load(stress[3] + first, n);
    R[0] += xx, R[1] += yy, R[2] += xy;
    R[3] += arm * xx, R[4] += arm * yy, R[5] += arm * xy;
    R[6] += w * load(stress[5] + first, n), R[7] += w * load(stress[4] + first, n);
  }
  R[6] *= factor, R[7] *= factor;
}
/// Those of the stress so far, kept for `integrate_layers`.
COURANT_INLINE void keep_resultants(Index first, Index n, Index k, int places, Real factor,
                                    const ShellState& state, ShellScratch& s) {
  const Native t = load(state.thickness + first, n);
  for (int q = 0; q < places; ++q) {
    Native R[8];
    resultants_of(first, n, q, places, factor, t, state, R);
    for (int m = 0; m < 8; ++m) store(s.resultant[8 * q + m] + k, R[m]);
  }
}
/// Those of the new stress, and their sum with the kept ones.
COURANT_INLINE void integrate_layers(Index first, Index n, Index k, int q, int places, Real factor, Native t,
                                     const ShellState& state, ShellScratch& s, Native R[8], Native both[8]) {
  resultants_of(first, n, q, places, factor, t, state, R);
  for (int m = 0; m < 8; ++m) {
    Real* const kept = s.resultant[8 * q + m] + k;
    both[m] = R[m] + load(kept);
    store(kept, R[m]);
  }
}

/// Bulk viscosity q = rho l (Q1 l e^2 - Q2 c e) in compression, e = D xx + D yy < 0, its energy, and the
/// stable step with and without it.
template <int corners>
COURANT_INLINE Native bulk_viscosity(Index first, Index n, Index k, Real dt, Native t, Native rho,
                                     const Triple d[3], const Flat& f, const ShellControl& control,
                                     const ShellState& state, ShellScratch& s) {
  const Length length = length_of<corners>(d, f, control, rho);
  const Native c = root(length.c2), l = root(f.A);
  const Native trace = load(s.membrane[0] + k) + load(s.membrane[1] + k),
               closing = native_max(-trace, all(0));
  const Native speed = control.Q1 * l * closing + control.Q2 * c;
  const Native q = rho * l * closing * speed;
  const Native damping = closing > 0.0 ? l / length.l * speed : all(0);
  store(s.step_limit + k, length.l / (damping + root(damping * damping + length.c2)));
  store(s.wave_time + k, length.l / c);
  if (state.viscous_force) {
    // that of each end of the step pushes through half of it, also where the shell opens by now
    const Native now = t * q, both = now + load(state.viscous_force + first, n);
    add_to(state.bulk_viscosity_energy + first, -0.5 * dt * load(s.middle_area + k) * trace * both, n);
    store(state.viscous_force + first, now, n);
  }
  return q;
}
/// Keeps the differences of positions for the forces, and takes them to the middle of the step.
template <int corners>
COURANT_INLINE void keep_places(Index k, Real dt, const Triple dv[3], Triple d[3], ShellScratch& s) {
  constexpr int modes = corners == quad ? 3 : 2;
  for (int m = 0; m < modes; ++m) {
    store(s.place[3 * m] + k, d[m].x), store(s.place[3 * m + 1] + k, d[m].y);
    store(s.place[3 * m + 2] + k, d[m].z);
    d[m] = d[m] - (0.5 * dt) * dv[m];
  }
}
/// Those of the end of the step.
template <int corners>
COURANT_INLINE void kept_places(Index k, const ShellScratch& s, Triple d[3]) {
  constexpr int modes = corners == quad ? 3 : 2;
  for (int m = 0; m < modes; ++m)
    d[m] = {load(s.place[3 * m] + k), load(s.place[3 * m + 1] + k), load(s.place[3 * m + 2] + k)};
}
/// The thickness at the end of the step, which ISTUPD 1 makes another one.
COURANT_INLINE Native new_thickness(Index first, Index n, Index k, Real dt, const ShellControl& control,
                                    const ShellState& state, const ShellScratch& s) {
  Native t = load(state.thickness + first, n);
  if (!control.thins) return t;
  const Native half = (0.5 * dt) * load(s.thickening + k);
  t *= (1.0 + half) / (1.0 - half);  // of second order
  store(state.thickness + first, t, n);
  return t;
}

/// The least stable step of a block.
COURANT_INLINE ShellLoops::StableStep shortest_of(const ShellLoops::Block& block,
                                                  const ShellScratch& scratch) {
  const Real* limit = scratch.step_limit;
  Index at = 0;
  for (Index i = 1; i < block.count; ++i)
    if (!(limit[i] >= limit[at]) && limit[at] == limit[at]) at = i;
  return {limit[at], block.begin + at};
}

}  // namespace courant::COURANT_SIMD
