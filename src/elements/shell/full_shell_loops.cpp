// Compiled once for each instruction set; see docs/architecture.md. Nothing here may be shared with other
// files.
//
// The shell of 2 x 2 points in its plane (ELFORM 16) on a block of elements. Of any nodal value
// v = b0 + b1 xi + b2 eta + b3 xi eta; forces come out along these, g0 to g3, and from there on the corners.
// Membrane and curvature are those of the bilinear map; in-plane shear is that of the middle, transverse
// shear is interpolated between the middles of the sides (Dvorkin & Bathe 1984). Theory:
// docs/theory_structures.md.
#include "elements/shell/quadrilateral_modes.hpp"
#include "elements/shell/shell_loops.hpp"

namespace courant::COURANT_SIMD {

namespace {

constexpr Real gauss = 0.57735026918962576;
constexpr Real xi_of[4] = {-gauss, gauss, gauss, -gauss}, eta_of[4] = {-gauss, -gauss, gauss, gauss};

/// Covariant rates of transverse shear at the middles of sides 1-2, 4-3, 1-4 and 2-3, and their mates.
struct SideShear {
  Native a, c, b, d;
};
/// What a rotation does there: slopes of the map along the sides, by which its values count.
struct Sides {
  Native xa, ya, xc, yc, xb, yb, xd, yd;
  COURANT_INLINE explicit Sides(const Modes& m) {
    xa = m.m[0].x - m.m[2].x, ya = m.m[0].y - m.m[2].y, xc = m.m[0].x + m.m[2].x, yc = m.m[0].y + m.m[2].y;
    xb = m.m[1].x - m.m[2].x, yb = m.m[1].y - m.m[2].y, xd = m.m[1].x + m.m[2].x, yd = m.m[1].y + m.m[2].y;
  }
};
COURANT_INLINE SideShear side_shear(const Sides& s, const Modes& v, const Triple& t0, const Modes& t) {
  const Native x = t0.x, y = t0.y, xs = t.m[0].x, ys = t.m[0].y, xt = t.m[1].x, yt = t.m[1].y;
  return {v.m[0].z - v.m[2].z + s.xa * (y - yt) - s.ya * (x - xt),
          v.m[0].z + v.m[2].z + s.xc * (y + yt) - s.yc * (x + xt),
          v.m[1].z - v.m[2].z + s.xb * (y - ys) - s.yb * (x - xs),
          v.m[1].z + v.m[2].z + s.xd * (y + ys) - s.yd * (x + xs)};
}
/// Twice D xz and D yz at a position.
struct Shear {
  Native xz, yz;
};
COURANT_INLINE Shear shear_at(const SideShear& g, const Map& map, Real s, Real t) {
  const Native along = 0.5 * (1 - t) * g.a + 0.5 * (1 + t) * g.c,
               across = 0.5 * (1 - s) * g.b + 0.5 * (1 + s) * g.d;
  const Native inverse = 1.0 / map.J;
  return {inverse * (along * map.yt - across * map.ys), inverse * (across * map.xs - along * map.xt)};
}

COURANT_INLINE void full_strain_of(Index first, Index n, Index k, Real dt, const ShellControl& control,
                                   const ShellMesh& mesh, const ShellState& state, ShellScratch& s) {
  keep_resultants(first, n, k, 4, control.shear_factor, state, s);
  Triple x[quad], v[quad], w[quad], d[3], dv[3], dw[3];
  gather_corners<quad>(mesh, first, n, x, v, w);
  differences<quad>(x, d), differences<quad>(v, dv), differences<quad>(w, dw);
  keep_places<quad>(k, dt, dv, d, s);
  const Flat f = flat_of<quad>(d, control.invariant_axes);
  store(s.middle_area + k, f.A);
  const Modes a = modes_of(f, d);
  const Rates r = rates_of(f, a, dv, dw, w);
  const Map middle(a, 0, 0);
  const Native vx[3] = {r.v.m[0].x, r.v.m[1].x, r.v.m[2].x}, vy[3] = {r.v.m[0].y, r.v.m[1].y, r.v.m[2].y},
               tx[3] = {r.t.m[0].x, r.t.m[1].x, r.t.m[2].x}, ty[3] = {r.t.m[0].y, r.t.m[1].y, r.t.m[2].y},
               tz[3] = {r.t.m[0].z, r.t.m[1].z, r.t.m[2].z};
  const Native shear_x = slope_y(middle, vx, 0, 0), shear_y = slope_x(middle, vy, 0, 0);
  store(s.membrane[0] + k, slope_x(middle, vx, 0, 0)), store(s.membrane[1] + k, slope_y(middle, vy, 0, 0));
  store(s.membrane[2] + k, 0.5 * (shear_x + shear_y));
  const Native turn = 0.5 * (shear_y - shear_x);
  for (int c = 0; c < quad; ++c) store(s.hourglass_rate[c] + k, at_corner(tz, r.t0.z, c) - turn);
  const SideShear sides = side_shear(Sides(a), r.v, r.t0, r.t);
  for (int q = 0; q < 4; ++q) {
    const Real p = xi_of[q], t = eta_of[q];
    const Map map(a, p, t);
    const Shear shear = shear_at(sides, map, p, t);
    Real(*const out)[block_size] = s.quarter[q];
    store(out[0] + k, slope_x(map, vx, p, t)), store(out[1] + k, slope_y(map, vy, p, t));
    store(out[2] + k, slope_x(map, ty, p, t)), store(out[3] + k, -slope_y(map, tx, p, t));
    store(out[4] + k, 0.5 * (slope_y(map, ty, p, t) - slope_x(map, tx, p, t)));
    store(out[5] + k, 0.5 * shear.xz), store(out[6] + k, 0.5 * shear.yz);
    store(s.quarter_area[q] + k, map.J);
  }
}

void full_at_point(const ShellLoops::Block& block, int point, const ShellState& state, ShellScratch& s) {
  Real z[block_size];
  heights_at(block, point, state, z);
  const Real(*const of)[block_size] = s.quarter[point / (state.points / 4)];
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    s.rate[0][i] = of[0][i] + z[i] * of[2][i];
    s.rate[1][i] = of[1][i] + z[i] * of[3][i];
    s.rate[3][i] = s.membrane[2][i] + z[i] * of[4][i];
    s.rate[4][i] = of[6][i];
    s.rate[5][i] = of[5][i];
  }
}

/// N, M and Q of one of the points in the plane; their work joins the internal energy.
COURANT_INLINE void integrate_quarter(Index first, Index n, Index k, Real dt, Real factor, Native t, int q,
                                      const ShellState& state, ShellScratch& s, Native R[8]) {
  Native both[8];
  integrate_layers(first, n, k, q, 4, factor, t, state, s, R, both);
  const Real(*const of)[block_size] = s.quarter[q];
  const Native power = both[0] * load(of[0] + k) + both[1] * load(of[1] + k) + both[3] * load(of[2] + k) +
                       both[4] * load(of[3] + k) +
                       2.0 * (both[2] * load(s.membrane[2] + k) + both[5] * load(of[4] + k) +
                              both[6] * load(of[5] + k) + both[7] * load(of[6] + k));
  add_to(state.internal_energy + first, 0.5 * dt * load(s.quarter_area[q] + k) * power, n);
}

/// Transverse shear: mates of the rates on the sides, then of the modes.
COURANT_INLINE void add_shear(const Sides& s, const SideShear& g, Native vz[3], Native tx[3], Native ty[3],
                              Triple& t0) {
  vz[0] += g.a + g.c, vz[1] += g.b + g.d, vz[2] += g.c - g.a + g.d - g.b;
  t0.y += g.a * s.xa + g.c * s.xc + g.b * s.xb + g.d * s.xd;
  t0.x -= g.a * s.ya + g.c * s.yc + g.b * s.yb + g.d * s.yd;
  ty[1] += g.c * s.xc - g.a * s.xa, tx[1] -= g.c * s.yc - g.a * s.ya;
  ty[0] += g.d * s.xd - g.b * s.xb, tx[0] -= g.d * s.yd - g.b * s.yb;
}

COURANT_INLINE void full_forces_of(Index first, Index n, Index k, Real dt, const ShellControl& control,
                                   const ShellState& state, ShellScratch& s) {
  Triple d[3];
  kept_places<quad>(k, s, d);
  const Flat f = flat_of<quad>(d, control.invariant_axes);
  const Native t = new_thickness(first, n, k, dt, control, state, s);
  const Native rho = load(state.mass + first, n) * f.inverse_A / t;
  const Native press = t * bulk_viscosity<quad>(first, n, k, dt, t, rho, d, f, control, state, s);
  const Modes a = modes_of(f, d);
  const Sides sides(a);
  Native vx[3], vy[3], vz[3], tx[3], ty[3];
  for (int m = 0; m < 3; ++m) vx[m] = vy[m] = vz[m] = tx[m] = ty[m] = all(0);
  Triple t0{all(0), all(0), all(0)};
  SideShear mates{all(0), all(0), all(0), all(0)};
  Native shear = all(0);
  for (int q = 0; q < 4; ++q) {
    const Real p = xi_of[q], e = eta_of[q];
    const Map map(a, p, e);
    Native R[8];
    integrate_quarter(first, n, k, dt, control.shear_factor, t, q, state, s, R);
    add_slopes(map, R[0] - press, all(0), p, e, vx), add_slopes(map, all(0), R[1] - press, p, e, vy);
    shear += map.J * R[2];
    add_slopes(map, R[3], R[5], p, e, ty), add_slopes(map, -R[5], -R[4], p, e, tx);
    const Native along = R[6] * map.yt - R[7] * map.xt, across = R[7] * map.xs - R[6] * map.ys;
    mates.a += 0.5 * (1 - e) * along, mates.c += 0.5 * (1 + e) * along;
    mates.b += 0.5 * (1 - p) * across, mates.d += 0.5 * (1 + p) * across;
  }
  Native mz[4];
  const Native drill = 0.5 * drilling(first, n, k, dt, t, f.A, control, state, s, 0, mz);
  const Map middle(a, 0, 0);
  const Native inverse = 1.0 / middle.J;
  add_slopes(middle, all(0), (shear + drill) * inverse, 0, 0, vx);
  add_slopes(middle, (shear - drill) * inverse, all(0), 0, 0, vy);
  add_shear(sides, mates, vz, tx, ty, t0);
  t0.z = mz[0];
  Triple g[3];
  for (int m = 0; m < 3; ++m) g[m] = {vx[m], vy[m], vz[m]};
  const Triple turns[3] = {{tx[0], ty[0], mz[1]}, {tx[1], ty[1], mz[2]}, {tx[2], ty[2], mz[3]}};
  push_corners(k, f, a, g, t0, turns, s);
}

void full_strain(const ShellLoops::Block& block, const ShellControl& control, const ShellMesh& mesh,
                 const ShellState& state, ShellScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    full_strain_of(block.begin + k, block.count - k < native_lanes ? block.count - k : native_lanes, k,
                   block.dt, control, mesh, state, scratch);
}

ShellLoops::StableStep full_forces(const ShellLoops::Block& block, const ShellControl& control,
                                   const ShellState& state, ShellScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    full_forces_of(block.begin + k, block.count - k < native_lanes ? block.count - k : native_lanes, k,
                   block.dt, control, state, scratch);
  return shortest_of(block, scratch);
}

}  // namespace

ShellLoops full_quadrilateral_loops() {
  return {&full_strain, &full_at_point, &full_forces};
}

}  // namespace courant::COURANT_SIMD
