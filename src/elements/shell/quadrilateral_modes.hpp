#pragma once
// What loops over quadrilaterals with warp have alike, in the files that are compiled once for
// each instruction set. Of any nodal value v = b0 + b1 xi + b2 eta + b3 xi eta; forces come out along these,
// g0 to g3, and from there on the corners.
#include "elements/shell/shell_geometry.hpp"

namespace courant::COURANT_SIMD {

/// Along xi, eta and xi eta, of vectors in the axes of the element.
struct Modes {
  Triple m[3];
};
COURANT_INLINE Triple in_axes(const Flat& f, const Triple& a) {
  return {dot(a, f.e1), dot(a, f.e2), dot(a, f.e3)};
}
COURANT_INLINE Modes modes_of(const Flat& f, const Triple d[3]) {
  return {{0.25 * in_axes(f, d[1] - d[0]), -0.25 * in_axes(f, d[0] + d[1]), 0.25 * in_axes(f, d[2])}};
}

/// Solves (sum |a|^2 1 - a a^T) w = L over the modes a of the positions: how a quadrilateral turns, over a
/// fourth of its second moments.
COURANT_INLINE Triple turn_of(const Modes& a, const Triple& L) {
  Native xx = all(0), yy = all(0), zz = all(0), xy = all(0), yz = all(0), zx = all(0);
  for (const Triple& m : a.m) {
    xx += m.y * m.y + m.z * m.z, yy += m.x * m.x + m.z * m.z, zz += m.x * m.x + m.y * m.y;
    xy -= m.x * m.y, yz -= m.y * m.z, zx -= m.z * m.x;
  }
  const Native cxx = yy * zz - yz * yz, cyy = xx * zz - zx * zx, czz = xx * yy - xy * xy,
               cxy = zx * yz - xy * zz, cyz = xy * zx - yz * xx, czx = xy * yz - zx * yy;
  const Native inverse = 1.0 / (xx * cxx + xy * cxy + zx * czx);
  return inverse * Triple{cxx * L.x + cxy * L.y + czx * L.z, cxy * L.x + cyy * L.y + cyz * L.z,
                          czx * L.x + cyz * L.y + czz * L.z};
}

/// Slopes of the map at a position of the plane.
struct Map {
  Native xs, xt, ys, yt, J;  ///< of x and y along xi and eta
  COURANT_INLINE Map(const Modes& a, Real s, Real t) {
    xs = a.m[0].x + t * a.m[2].x, ys = a.m[0].y + t * a.m[2].y;
    xt = a.m[1].x + s * a.m[2].x, yt = a.m[1].y + s * a.m[2].y;
    J = xs * yt - xt * ys;
  }
};

/// Slopes there of a value with the modes b.
COURANT_INLINE Native slope_x(const Map& m, const Native b[3], Real s, Real t) {
  return ((b[0] + t * b[2]) * m.yt - (b[1] + s * b[2]) * m.ys) / m.J;
}
COURANT_INLINE Native slope_y(const Map& m, const Native b[3], Real s, Real t) {
  return ((b[1] + s * b[2]) * m.xs - (b[0] + t * b[2]) * m.xt) / m.J;
}

/// Rates of a quadrilateral without its rigid motion: exact for warped ones, too.
struct Rates {
  Modes v, t;
  Triple t0;
};
COURANT_INLINE Rates rates_of(const Flat& f, const Modes& a, const Triple dv[3], const Triple dw[3],
                              const Triple w[quad]) {
  Rates out{modes_of(f, dv), modes_of(f, dw), {}};
  const Triple turn =
      turn_of(a, cross(a.m[0], out.v.m[0]) + cross(a.m[1], out.v.m[1]) + cross(a.m[2], out.v.m[2]));
  for (int k = 0; k < 3; ++k) out.v.m[k] = out.v.m[k] - cross(turn, a.m[k]);
  out.t0 = 0.25 * in_axes(f, w[0] + w[1] + w[2] + w[3]) - turn;
  return out;
}

COURANT_INLINE Native at_corner(const Native b[3], Native b0, int c) {
  constexpr Real xi[4] = {-1, 1, 1, -1}, eta[4] = {-1, -1, 1, 1};
  return b0 + xi[c] * b[0] + eta[c] * b[1] + (xi[c] * eta[c]) * b[2];
}

/// P per slope x and R per slope y of a value, at a position.
COURANT_INLINE void add_slopes(const Map& m, Native P, Native R, Real s, Real t, Native g[3]) {
  const Native along = P * m.yt - R * m.xt, across = R * m.xs - P * m.ys;
  g[0] += along, g[1] += across, g[2] += t * along + s * across;
}

/// Moments against what nodes turn beyond the middle of the plane; what they store is counted as hourglass
/// energy. Returns their sum; `mz`: along the modes. `at`: where they stand among the generalised forces.
COURANT_INLINE Native drilling(Index first, Index n, Index k, Real dt, Native t, Native A,
                               const ShellControl& control, const ShellState& state, const ShellScratch& s,
                               int at, Native mz[4]) {
  constexpr Real xi[4] = {-1, 1, 1, -1}, eta[4] = {-1, -1, 1, 1};
  for (int m = 0; m < 4; ++m) mz[m] = all(0);
  if (!(control.drilling > 0)) return mz[0];
  constexpr Real thickest = 4;
  const Native stiffness = (0.25 * control.drilling * control.G) * t * (A + native_min(t * t, thickest * A));
  Native taken = all(0);
  for (int c = 0; c < quad; ++c) {
    const Native rate = load(s.hourglass_rate[at + c] + k), old = load(state.hourglass[at + c] + first, n);
    const Native moment = old + dt * stiffness * rate;
    store(state.hourglass[at + c] + first, moment, n);
    taken += 0.5 * (old + moment) * rate;
    mz[0] += moment, mz[1] += xi[c] * moment, mz[2] += eta[c] * moment, mz[3] += (xi[c] * eta[c]) * moment;
  }
  add_to(state.hourglass_energy + first, dt * taken, n);
  return mz[0];
}

/// From forces along modes to what acts on the corners, in global axes.
COURANT_INLINE void on_corners_of(Real (*out)[block_size], Index k, const Flat& f, const Triple& g0,
                                  const Triple g[3]) {
  constexpr Real xi[4] = {-1, 1, 1, -1}, eta[4] = {-1, -1, 1, 1};
  for (int c = 0; c < quad; ++c) {
    const Triple a = -0.25 * (g0 + xi[c] * g[0] + eta[c] * g[1] + (xi[c] * eta[c]) * g[2]);
    store_vector(out + 3 * c, k, a.x * f.e1 + a.y * f.e2 + a.z * f.e3);
  }
}

/// Forces `of_v` along the modes and moments `t0`, `of_w` as forces and moments on the corners. Nothing
/// resists a rigid rotation: the transpose of rates_of.
COURANT_INLINE void push_corners(Index k, const Flat& f, const Modes& a, Triple of_v[3], const Triple& t0,
                                 const Triple of_w[3], ShellScratch& s) {
  const Triple turn =
      turn_of(a, cross(a.m[0], of_v[0]) + cross(a.m[1], of_v[1]) + cross(a.m[2], of_v[2]) + t0);
  for (int m = 0; m < 3; ++m) of_v[m] = of_v[m] - cross(turn, a.m[m]);
  const Triple none{all(0), all(0), all(0)};
  on_corners_of(s.corner_force, k, f, none, of_v);
  on_corners_of(s.corner_moment, k, f, t0, of_w);
}

}  // namespace courant::COURANT_SIMD
