#pragma once
// What loops over hexahedra share, one point or eight: modes of places and velocities, volumes, bulk
// viscosity and the stable step. For files that are compiled once for each instruction set: all is inlined
// there.
#include "elements/native_math.hpp"
#include "elements/solid/hexahedron_loops.hpp"

namespace courant::COURANT_SIMD {

COURANT_INLINE Triple triple(const Real (*rows)[block_size], Index k) {
  return {load(rows[0] + k), load(rows[1] + k), load(rows[2] + k)};
}

/// x^(-1/3) for normal x > 0, to the last few bits: a guess from the exponent within a tenth, then three
/// steps of third order.
COURANT_INLINE Native inverse_cube_root(Native x) {
  using Bits = unsigned long long __attribute__((vector_size(COURANT_SIMD_BYTES)));
  constexpr unsigned long long large = 0x4330000000000000;  // of 2^52, whose last bits count ones
  const Native high = Native((Bits(x) >> 32) | large) - 0x1p52;
  Native y = Native(Bits((1429986000.0 - high * (1.0 / 3)) + 0x1p52) << 32);
  for (int k = 0; k < 3; ++k) {
    const Native e = 1.0 - x * y * y * y;
    y += y * e * (1.0 / 3 + e * (2.0 / 9));
  }
  return y;
}

/// Modes 1 to 7 of eight numbers, one for each corner: xi, eta, zeta, eta zeta, zeta xi, xi eta, xi eta zeta.
COURANT_INLINE void modes_of(const Native p[8], Native out[7]) {
  const Native s01 = p[1] + p[0], d01 = p[1] - p[0], s32 = p[2] + p[3], d32 = p[2] - p[3];
  const Native s45 = p[5] + p[4], d45 = p[5] - p[4], s76 = p[6] + p[7], d76 = p[6] - p[7];
  const Native ss0 = s32 + s01, sd0 = s32 - s01, ds0 = d32 + d01, dd0 = d32 - d01;
  const Native ss1 = s76 + s45, sd1 = s76 - s45, ds1 = d76 + d45, dd1 = d76 - d45;
  out[0] = ds1 + ds0, out[1] = sd1 + sd0, out[2] = ss1 - ss0;
  out[3] = sd1 - sd0, out[4] = ds1 - ds0, out[5] = dd1 + dd0, out[6] = dd1 - dd0;
}

/// The numbers at the corners that have these modes, and no mode 0.
COURANT_INLINE void corners_of(const Native m[7], Native out[8]) {
  const Native d0 = m[5] - m[6], d1 = m[5] + m[6], c0 = m[0] - m[4], c1 = m[0] + m[4];
  const Native b0 = m[1] - m[3], b1 = m[1] + m[3];
  const Native low0 = -m[2] - b0, low1 = m[2] - b1, high0 = b0 - m[2], high1 = b1 + m[2];
  out[0] = low0 - (c0 - d0), out[1] = low0 + (c0 - d0);
  out[3] = high0 - (c0 + d0), out[2] = high0 + (c0 + d0);
  out[4] = low1 - (c1 - d1), out[5] = low1 + (c1 - d1);
  out[7] = high1 - (c1 + d1), out[6] = high1 + (c1 + d1);
}

/// 64 dV/da_k of modes 1 to 6, and 64 V.
struct Geometry {
  Triple g[6];
  Native V64;
};
COURANT_INLINE Geometry geometry(const Triple a[7]) {
  constexpr Real third = 1.0 / 3;
  Geometry out;
  out.g[0] = cross(a[1], a[2]) + third * cross(a[5], a[4]);
  out.g[1] = cross(a[2], a[0]) + third * cross(a[3], a[5]);
  out.g[2] = cross(a[0], a[1]) + third * cross(a[4], a[3]);
  out.g[3] = third * (cross(a[2], a[4]) + cross(a[5], a[1]));
  out.g[4] = third * (cross(a[3], a[2]) + cross(a[0], a[5]));
  out.g[5] = third * (cross(a[1], a[3]) + cross(a[4], a[0]));
  out.V64 = dot(a[0], out.g[0]) + dot(a[3], out.g[3]);
  return out;
}
COURANT_INLINE Native volume64(const Triple a[7]) {
  return dot(a[0], cross(a[1], a[2])) +
         (1.0 / 3) * (dot(a[0], cross(a[5], a[4])) + dot(a[3], cross(a[2], a[4]) + cross(a[5], a[1])));
}

/// Squares of the vectors of two opposite faces, (b +- f) x (c +- e)/16, times 256: the larger one.
COURANT_INLINE Native larger_face2(const Triple& b, const Triple& f, const Triple& c, const Triple& e) {
  const Triple even = cross(b, c) + cross(f, e), odd = cross(b, e) + cross(f, c);
  const Native twice = 2.0 * dot(even, odd);
  return dot(even, even) + dot(odd, odd) + native_max(twice, -twice);
}
COURANT_INLINE Native largest_face(const Triple a[7]) {
  return 0.0625 * root(native_max(larger_face2(a[1], a[5], a[2], a[4]),
                                  native_max(larger_face2(a[2], a[3], a[0], a[5]),
                                             larger_face2(a[0], a[4], a[1], a[3]))));
}

/// Modes of places and velocities, kept for the forces, too.
COURANT_INLINE void gather_modes(const HexahedronMesh& mesh, Index first, Index n, Index k,
                                 HexahedronScratch& scratch, Native x[3][7], Native v[3][7]) {
  Native px[3][8], pv[3][8];
  Index last[8][native_lanes];
  const Index* nodes[8];
  for (int c = 0; c < 8; ++c) {
    nodes[c] = mesh.corner[c] + first;
    if (n >= native_lanes) continue;
    for (Index l = 0; l < native_lanes; ++l) last[c][l] = nodes[c][l < n ? l : n - 1];
    nodes[c] = last[c];
  }
  for (int c = 0; c < 8; ++c)  // not by component: each index is read once
    for (int d = 0; d < 3; ++d)
      px[d][c] = gather(mesh.x[d], nodes[c]), pv[d][c] = gather(mesh.v[d], nodes[c]);
  for (int d = 0; d < 3; ++d) {
    modes_of(px[d], x[d]), modes_of(pv[d], v[d]);
    for (int m = 0; m < 7; ++m)
      store(scratch.place[3 * m + d] + k, x[d][m]), store(scratch.speed[3 * m + d] + k, v[d][m]);
  }
}

COURANT_INLINE void add(Real* p, Native a, Index n) {
  store(p, load(p, n) + a, n);
}

/// q = rho l (Q1 l e^2 - Q2 c e) in compression, e = tr D < 0, l the cube root
/// of the volume.
COURANT_INLINE Native bulk_viscosity(Native rho, Native l, Native c, Native closing,
                                     const HexahedronControl& control) {
  return rho * l * closing * (control.Q1 * l * closing + control.Q2 * c);
}
COURANT_INLINE Native trace_of(const HexahedronScratch& scratch, Index k) {
  return load(scratch.rate[0] + k) + load(scratch.rate[1] + k) + load(scratch.rate[2] + k);
}

/// What a block has at the end of a step beside its stress: density, sound speed, size, q.
struct Compressed {
  Native inverse_V64, rho, c, l, q;
};
/// Relative volume, bulk viscosity with what it takes, and the stable step.
COURANT_INLINE Compressed compressed(Index first, Index n, Index k, Real dt, const HexahedronControl& control,
                                     const HexahedronState& state, const Triple a[7], Native V64,
                                     HexahedronScratch& scratch) {
  const Native area = largest_face(a);
  const Native V = 0.015625 * V64, inverse_V64 = 1.0 / V64;
  const Native V0 = load(state.V0 + first, n), rho = 64.0 * load(state.rho0 + first, n) * V0 * inverse_V64;
  store(scratch.relative_volume + k, V / V0);

  const Native c = load(scratch.sound_speed + k, n), r = inverse_cube_root(V), l = V * r * r;
  const Native closing = native_max(-trace_of(scratch, k), all(0));
  const Native q =
      state.heats ? load(state.viscous_pressure + first, n) : bulk_viscosity(rho, l, c, closing, control);
  const Native length = V / area;
  // damping ratio Q/c of a wave through the thickness of the element, of which q makes more than usual where
  // it is flatter than a cube
  const Native of_q = closing > 0.0 ? l / length * (control.Q2 * c + control.Q1 * l * closing) : all(0);
  const Native Q = of_q + 4.0 / 3 * control.MU / (rho * length);
  store(scratch.step_limit + k, length / (Q + root(Q * Q + c * c)));
  store(scratch.wave_time + k, length / c);
  if (!state.heats && state.viscous_pressure) {
    // the q of each end of the step pushes through half of it, also where the element opens by now
    const Native both = q + load(state.viscous_pressure + first, n);
    add(state.bulk_viscosity_energy + first,
        -0.5 * dt * load(scratch.middle_volume + k) * trace_of(scratch, k) * both, n);
    store(state.viscous_pressure + first, q, n);
  }
  return {inverse_V64, rho, c, l, q};
}

/// Which is the least; the first that is not a number, where there is one.
inline Index least(const Real* values, Index count) {
  Index at = 0;
  for (Index i = 1; i < count; ++i)
    if (!(values[i] >= values[at]) && values[at] == values[at]) at = i;
  return at;
}
/// The shortest step of a block, and its most compressed element.
inline HexahedronLoops::StableStep found_in(const HexahedronLoops::Block& block,
                                            const HexahedronScratch& scratch) {
  const Index shortest = least(scratch.step_limit, block.count);
  const Index smallest = least(scratch.relative_volume, block.count);
  return {scratch.step_limit[shortest], block.begin + shortest, scratch.relative_volume[smallest],
          block.begin + smallest};
}

}  // namespace courant::COURANT_SIMD
