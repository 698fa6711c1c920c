// Compiled once for each instruction set; see docs/architecture.md. Nothing here may be shared with other
// files.
//
// The shell of one point in its plane (ELFORM 2) that respects its warp (BWC 1), on a block of elements: what
// shell_loops.cpp does, of velocities and forces without their rigid part, with a small stiffness against
// drilling, through which moments pass from facet to facet.
#include "elements/shell/one_point.hpp"
#include "elements/shell/quadrilateral_modes.hpp"

namespace courant::COURANT_SIMD {

namespace {

constexpr int drilling_at = ShellState::hourglass_modes;

/// The part of a value with the modes b that is not linear in x and y, at corners 1 and 3; -that at 2 and 4.
COURANT_INLINE Native hourglass_part(const Flat& f, const Map& middle, const Native b[3]) {
  return 4.0 * b[2] - f.hx * slope_x(middle, b, 0, 0) - f.hy * slope_y(middle, b, 0, 0);
}

COURANT_INLINE void warped_strain_of(Index first, Index n, Index k, Real dt, const ShellControl& control,
                                     const ShellMesh& mesh, const ShellState& state, ShellScratch& s) {
  keep_resultants(first, n, k, 1, control.shear_factor, state, s);
  Triple x[quad], v[quad], w[quad], d[3], dv[3], dw[3];
  gather_corners<quad>(mesh, first, n, x, v, w);
  differences<quad>(x, d), differences<quad>(v, dv), differences<quad>(w, dw);
  keep_places<quad>(k, dt, dv, d, s);
  const Flat f = flat_of<quad>(d, control.invariant_axes);
  store(s.middle_area + k, f.A);
  const Modes a = modes_of(f, d);
  const Rates r = rates_of(f, a, dv, dw, w);
  const Map middle(a, 0, 0);
  Native b[6][3];  // vx vy vz wx wy wz
  for (int m = 0; m < 3; ++m) {
    b[0][m] = r.v.m[m].x, b[1][m] = r.v.m[m].y, b[2][m] = r.v.m[m].z;
    b[3][m] = r.t.m[m].x, b[4][m] = r.t.m[m].y, b[5][m] = r.t.m[m].z;
  }
  const Native vx_y = slope_y(middle, b[0], 0, 0), vy_x = slope_x(middle, b[1], 0, 0);
  store(s.membrane[0] + k, slope_x(middle, b[0], 0, 0)),
      store(s.membrane[1] + k, slope_y(middle, b[1], 0, 0));
  store(s.membrane[2] + k, 0.5 * (vx_y + vy_x));
  store(s.curvature[0] + k, slope_x(middle, b[4], 0, 0));
  store(s.curvature[1] + k, -slope_y(middle, b[3], 0, 0));
  store(s.curvature[2] + k, 0.5 * (slope_y(middle, b[4], 0, 0) - slope_x(middle, b[3], 0, 0)));
  store(s.shear[0] + k, 0.5 * (slope_x(middle, b[2], 0, 0) + r.t0.y));
  store(s.shear[1] + k, 0.5 * (slope_y(middle, b[2], 0, 0) - r.t0.x));
  for (int m = 0; m < drilling_at; ++m) store(s.hourglass_rate[m] + k, hourglass_part(f, middle, b[m]));
  const Native turn = 0.5 * (vy_x - vx_y);
  for (int c = 0; c < quad; ++c)
    store(s.hourglass_rate[drilling_at + c] + k, at_corner(b[5], r.t0.z, c) - turn);
}

COURANT_INLINE void warped_forces_of(Index first, Index n, Index k, Real dt, const ShellControl& control,
                                     const ShellState& state, ShellScratch& s) {
  Triple d[3];
  kept_places<quad>(k, s, d);
  const Flat f = flat_of<quad>(d, control.invariant_axes);
  const Native t = new_thickness(first, n, k, dt, control, state, s);
  Native R[8], Q[5];
  integrate(first, n, k, dt, control.shear_factor, t, state, s, R);
  const Native rho = load(state.mass + first, n) * f.inverse_A / t;
  const Native press = t * bulk_viscosity<quad>(first, n, k, dt, t, rho, d, f, control, state, s);
  hourglass_forces(first, n, k, dt, t, f, rho, control, state, s, Q);
  Native mz[4];
  const Native drill = 0.5 * drilling(first, n, k, dt, t, f.A, control, state, s, drilling_at, mz);
  const Modes a = modes_of(f, d);
  const Map middle(a, 0, 0);
  // per slope x and y of vx vy vz wx wy; the map has a fourth of the area
  const Native slope[5][2] = {
      {R[0] - press, R[2]}, {R[2], R[1] - press}, {R[6], R[7]}, {-R[5], -R[4]}, {R[3], R[5]}};
  Native g[5][3];
  for (int m = 0; m < 5; ++m) {
    g[m][0] = g[m][1] = all(0), g[m][2] = 4.0 * Q[m];
    const Native q = Q[m] * f.inverse_A;
    add_slopes(middle, 4.0 * (slope[m][0] - f.hx * q), 4.0 * (slope[m][1] - f.hy * q), 0, 0, g[m]);
  }
  const Native inverse = drill / middle.J;
  add_slopes(middle, all(0), inverse, 0, 0, g[0]), add_slopes(middle, -inverse, all(0), 0, 0, g[1]);
  const Triple t0{-f.A * R[7], f.A * R[6], mz[0]};
  Triple of_v[3];
  for (int m = 0; m < 3; ++m) of_v[m] = {g[0][m], g[1][m], g[2][m]};
  const Triple of_w[3] = {{g[3][0], g[4][0], mz[1]}, {g[3][1], g[4][1], mz[2]}, {g[3][2], g[4][2], mz[3]}};
  push_corners(k, f, a, of_v, t0, of_w, s);
}

void warped_strain(const ShellLoops::Block& block, const ShellControl& control, const ShellMesh& mesh,
                   const ShellState& state, ShellScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    warped_strain_of(block.begin + k, block.count - k < native_lanes ? block.count - k : native_lanes, k,
                     block.dt, control, mesh, state, scratch);
}

ShellLoops::StableStep warped_forces(const ShellLoops::Block& block, const ShellControl& control,
                                     const ShellState& state, ShellScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    warped_forces_of(block.begin + k, block.count - k < native_lanes ? block.count - k : native_lanes, k,
                     block.dt, control, state, scratch);
  return shortest_of(block, scratch);
}

}  // namespace

ShellLoops warped_quadrilateral_loops() {
  return {&warped_strain, &at_point, &warped_forces};
}

}  // namespace courant::COURANT_SIMD
