// Compiled once for each instruction set; see docs/architecture.md. Nothing here may be shared with other
// files. A register holds as many elements as it has space for; what is behind the last element of a block
// repeats that one and is not stored.
#include "elements/shell/shell_loops.hpp"

#include "elements/shell/one_point.hpp"

namespace courant::COURANT_SIMD {

namespace {

/// Of a triangle: 2 D xz has wy_I xy[I] - wx_I xx[I] besides the slope of vz, 2 D yz the same with y: the
/// mean over the three corners of discrete shear gaps (Bletzinger, Bischoff & Ramm 2000).
struct ShearGaps {
  Native xy[3], xx[3], yy[3], yx[3];
};
COURANT_INLINE ShearGaps shear_gaps(const Flat& f) {
  const Native px[3] = {all(0), f.x0, f.x1}, py[3] = {all(0), f.y0, f.y1};
  ShearGaps out;
  for (int i = 0; i < 3; ++i) out.xy[i] = out.xx[i] = out.yy[i] = out.yx[i] = all(0);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Native a = px[j] - px[i], b = py[j] - py[i], c = py[k] - py[i], d = px[k] - px[i];
    out.xy[i] += f.A, out.yx[i] += f.A;
    out.xy[j] += 0.5 * a * c, out.xx[j] += 0.5 * b * c, out.yy[j] -= 0.5 * a * d, out.yx[j] -= 0.5 * b * d;
    out.xy[k] -= 0.5 * b * d, out.xx[k] -= 0.5 * b * c, out.yy[k] += 0.5 * a * d, out.yx[k] += 0.5 * a * c;
  }
  const Native scale = (1.0 / 6) * f.inverse_A;
  for (int i = 0; i < 3; ++i) out.xy[i] *= scale, out.xx[i] *= scale, out.yy[i] *= scale, out.yx[i] *= scale;
  return out;
}

template <int corners>
COURANT_INLINE void strain_of(Index first, Index n, Index k, Real dt, const ShellControl& control,
                              const ShellMesh& mesh, const ShellState& state, ShellScratch& s) {
  keep_resultants(first, n, k, 1, control.shear_factor, state, s);
  Triple x[corners], v[corners], w[corners], d[3], dv[3], dw[3];
  gather_corners<corners>(mesh, first, n, x, v, w);
  differences<corners>(x, d), differences<corners>(v, dv), differences<corners>(w, dw);
  keep_places<corners>(k, dt, dv, d, s);
  const Flat f = flat_of<corners>(d, control.invariant_axes);
  store(s.middle_area + k, f.A);
  const Slopes vx = slopes(f, dot(dv[0], f.e1), dot(dv[1], f.e1)),
               vy = slopes(f, dot(dv[0], f.e2), dot(dv[1], f.e2)),
               vz = slopes(f, dot(dv[0], f.e3), dot(dv[1], f.e3)),
               wx = slopes(f, dot(dw[0], f.e1), dot(dw[1], f.e1)),
               wy = slopes(f, dot(dw[0], f.e2), dot(dw[1], f.e2));
  const Native scale = f.inverse_A, half = 0.5 * scale;
  store(s.membrane[0] + k, scale * vx.x), store(s.membrane[1] + k, scale * vy.y);
  store(s.membrane[2] + k, half * (vx.y + vy.x));
  store(s.curvature[0] + k, scale * wy.x), store(s.curvature[1] + k, -scale * wx.y);
  store(s.curvature[2] + k, half * (wy.y - wx.x));
  Native xz = scale * vz.x, yz = scale * vz.y;
  if (corners == quad) {
    const Triple sum = w[0] + w[1] + w[2] + w[corners - 1];
    xz += 0.25 * dot(sum, f.e2), yz -= 0.25 * dot(sum, f.e1);
    const Native a = f.hx * scale, b = f.hy * scale;
    const Slopes g[5] = {vx, vy, vz, wx, wy};
    const Native plain[5] = {dot(dv[2], f.e1), dot(dv[2], f.e2), dot(dv[2], f.e3), dot(dw[2], f.e1),
                             dot(dw[2], f.e2)};
    for (int m = 0; m < 5; ++m) store(s.hourglass_rate[m] + k, plain[m] - a * g[m].x - b * g[m].y);
  } else {
    const ShearGaps gaps = shear_gaps(f);
    for (int i = 0; i < 3; ++i) {
      const Native ax = dot(w[i], f.e1), ay = dot(w[i], f.e2);
      xz += gaps.xy[i] * ay - gaps.xx[i] * ax, yz += gaps.yy[i] * ay - gaps.yx[i] * ax;
    }
  }
  store(s.shear[0] + k, 0.5 * xz), store(s.shear[1] + k, 0.5 * yz);
}

/// Forces along the differences and the hourglass mode, turned to the global axes, become those on corners.
template <int corners>
COURANT_INLINE void to_corners(Real (*out)[block_size], Index k, const Triple& d0, const Triple& d1,
                               const Triple& h) {
  const Triple none{all(0), all(0), all(0)};
  if (corners == quad) {
    store_vector(out, k, none - d0 - h), store_vector(out + 3, k, h - d1);
    store_vector(out + 6, k, d0 - h), store_vector(out + 9, k, d1 + h);
  } else {
    store_vector(out, k, d0 + d1), store_vector(out + 3, k, none - d0);
    store_vector(out + 6, k, none - d1);
  }
}

template <int corners>
COURANT_INLINE void store_moments(Index k, const Flat& f, const Native R[8], const Native Q[5],
                                  ShellScratch& scratch) {
  const Native a = f.hx * f.inverse_A, b = f.hy * f.inverse_A;
  const bool has_hourglass = corners == quad;
  const Native qx = has_hourglass ? Q[3] : all(0), qy = has_hourglass ? Q[4] : all(0);
  const SideForces x = has_hourglass ? along(f, -R[5] - a * qx, -R[4] - b * qx) : along(f, -R[5], -R[4]),
                   y = has_hourglass ? along(f, R[3] - a * qy, R[5] - b * qy) : along(f, R[3], R[5]);
  const Triple d0 = x.d0 * f.e1 + y.d0 * f.e2, d1 = x.d1 * f.e1 + y.d1 * f.e2;
  Real(*const out)[block_size] = scratch.corner_moment;
  if (corners == quad) {
    const Triple h = qx * f.e1 + qy * f.e2;
    const Native part = -0.25 * f.A;  // of shear, the same on all corners
    const Triple s = (-part * R[7]) * f.e1 + (part * R[6]) * f.e2;
    store_vector(out, k, s - d0 - h), store_vector(out + 3, k, s - d1 + h);
    store_vector(out + 6, k, s + d0 - h), store_vector(out + 9, k, s + d1 + h);
  } else {
    const ShearGaps gaps = shear_gaps(f);
    Triple s[3];
    for (int i = 0; i < 3; ++i)
      s[i] = (f.A * (gaps.xx[i] * R[6] + gaps.yx[i] * R[7])) * f.e1 -
             (f.A * (gaps.xy[i] * R[6] + gaps.yy[i] * R[7])) * f.e2;
    store_vector(out, k, s[0] + d0 + d1), store_vector(out + 3, k, s[1] - d0);
    store_vector(out + 6, k, s[2] - d1);
  }
}

template <int corners>
COURANT_INLINE void forces_of(Index first, Index n, Index k, Real dt, const ShellControl& control,
                              const ShellState& state, ShellScratch& s) {
  Triple d[3];
  kept_places<corners>(k, s, d);
  const Flat f = flat_of<corners>(d, control.invariant_axes);
  const Native t = new_thickness(first, n, k, dt, control, state, s);
  Native R[8], Q[5];
  integrate(first, n, k, dt, control.shear_factor, t, state, s, R);
  const Native rho = load(state.mass + first, n) * f.inverse_A / t;
  const Native q = bulk_viscosity<corners>(first, n, k, dt, t, rho, d, f, control, state, s);

  const Native Nxx = R[0] - q * t, Nyy = R[1] - q * t;
  SideForces x, y, z;
  Triple h{all(0), all(0), all(0)};
  if (corners == quad) {
    hourglass_forces(first, n, k, dt, t, f, rho, control, state, s, Q);
    const Native a = f.hx * f.inverse_A, b = f.hy * f.inverse_A;
    x = along(f, Nxx - a * Q[0], R[2] - b * Q[0]), y = along(f, R[2] - a * Q[1], Nyy - b * Q[1]);
    z = along(f, R[6] - a * Q[2], R[7] - b * Q[2]);
    h = Q[0] * f.e1 + Q[1] * f.e2 + Q[2] * f.e3;
  } else {
    x = along(f, Nxx, R[2]), y = along(f, R[2], Nyy), z = along(f, R[6], R[7]);
  }
  to_corners<corners>(s.corner_force, k, x.d0 * f.e1 + y.d0 * f.e2 + z.d0 * f.e3,
                      x.d1 * f.e1 + y.d1 * f.e2 + z.d1 * f.e3, h);
  store_moments<corners>(k, f, R, Q, s);
}

template <int corners>
void strain(const ShellLoops::Block& block, const ShellControl& control, const ShellMesh& mesh,
            const ShellState& state, ShellScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    strain_of<corners>(block.begin + k, block.count - k < native_lanes ? block.count - k : native_lanes, k,
                       block.dt, control, mesh, state, scratch);
}

template <int corners>
ShellLoops::StableStep forces(const ShellLoops::Block& block, const ShellControl& control,
                              const ShellState& state, ShellScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes)
    forces_of<corners>(block.begin + k, block.count - k < native_lanes ? block.count - k : native_lanes, k,
                       block.dt, control, state, scratch);
  return shortest_of(block, scratch);
}

}  // namespace

ShellLoops quadrilateral_loops() {
  return {&strain<quad>, &at_point, &forces<quad>};
}
ShellLoops triangle_loops() {
  return {&strain<3>, &at_point, &forces<3>};
}

}  // namespace courant::COURANT_SIMD
