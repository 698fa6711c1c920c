// Compiled once for each instruction set; see docs/architecture.md. Nothing here may be shared with other
// files. A register holds as many elements as it has room for; what is behind the last element of a block
// repeats that one and is not stored.
#include "elements/solid/hexahedron_loops.hpp"

#include "elements/native_math.hpp"
#include "laws/objective.hpp"

namespace courant::COURANT_SIMD {

namespace {

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

/// 64 V times the gradient of one component of v, given by its modes. Those above 6 have no part in it.
COURANT_INLINE Triple gradient64(const Native w[7], const Triple g[6]) {
  Triple out{w[0] * g[0].x, w[0] * g[0].y, w[0] * g[0].z};
  for (int k = 1; k < 6; ++k) out = {out.x + w[k] * g[k].x, out.y + w[k] * g[k].y, out.z + w[k] * g[k].z};
  return out;
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

COURANT_INLINE void strain_of(Index first, Index n, Index k, Real dt, const HexahedronMesh& mesh,
                              const HexahedronState& state, HexahedronScratch& scratch) {
  Native x[3][7], v[3][7];
  gather_modes(mesh, first, n, k, scratch, x, v);
  Triple a[7], L[3];
  for (int m = 0; m < 7; ++m) a[m] = {x[0][m], x[1][m], x[2][m]};
  store(scratch.compression + k, 64.0 * load(state.V0 + first, n) / volume64(a) - 1.0);
  const Real back = -0.5 * dt;
  for (int m = 0; m < 6; ++m)
    a[m] = {x[0][m] + back * v[0][m], x[1][m] + back * v[1][m], x[2][m] + back * v[2][m]};
  const Geometry middle = geometry(a);
  for (int i = 0; i < 3; ++i) L[i] = gradient64(v[i], middle.g);
  const Native scale = 1.0 / middle.V64, half = 0.5 * scale, turn = 0.5 * dt * half;
  const Native V = 0.015625 * middle.V64;
  store(scratch.middle_volume + k, V);
  Native D[6] = {scale * L[0].x,           scale * L[1].y,           scale * L[2].z,
                 half * (L[0].y + L[1].x), half * (L[1].z + L[2].y), half * (L[2].x + L[0].z)};
  const Triple h{turn * (L[2].y - L[1].z), turn * (L[0].z - L[2].x), turn * (L[1].x - L[0].y)};
  store(scratch.half_turn[0] + k, h.x), store(scratch.half_turn[1] + k, h.y);
  store(scratch.half_turn[2] + k, h.z);
  turn_rate(h.x, h.y, h.z, D[0], D[1], D[2], D[3], D[4], D[5]);
  Native s[6];
  for (int j = 0; j < 6; ++j) store(scratch.rate[j] + k, D[j]), s[j] = load(state.stress[j] + first, n);
  turn_tensor(h.x, h.y, h.z, s[0], s[1], s[2], s[3], s[4], s[5]);
  for (int j = 0; j < 6; ++j) store(state.stress[j] + first, s[j], n);
  for (int t = 0; t < state.tensors; ++t) {
    Native kept[6];
    for (int j = 0; j < 6; ++j) kept[j] = load(state.tensor[t][j] + first, n);
    turn_tensor(h.x, h.y, h.z, kept[0], kept[1], kept[2], kept[3], kept[4], kept[5]);
    for (int j = 0; j < 6; ++j) store(state.tensor[t][j] + first, kept[j], n);
  }
  const Native power =
      s[0] * D[0] + s[1] * D[1] + s[2] * D[2] + 2.0 * (s[3] * D[3] + s[4] * D[4] + s[5] * D[5]);
  store(scratch.work + k, 0.5 * dt * V * power);
}

/// One component of the corner forces, by its modes: -T b and those of hourglass control, -a Gamma (rate), or
/// -Gamma (what a stiffness has made of all rates). Returns the sum of squares of the rates, or the power.
/// With the modes gamma that linear fields leave alone, gamma = Gamma - b.(sum x Gamma)/V, the second term of
/// the forces has the form of a stress.
struct Hourglass {
  Native a;  ///< force over rate of a mode [M/T]; with a stiffness its growth in the step
  bool plain;
  Native inverse_V64;
  Native* kept = nullptr;  ///< with a stiffness: forces of the four modes, turned; out: now [ML/T2]
};
COURANT_INLINE Native force_modes(const Triple a[7], const Native w[7], const Geometry& q, Triple T,
                                  const Hourglass& h, Native out[7]) {
  Native rate[4] = {w[3], w[4], w[5], w[6]};
  if (!h.plain) {
    const Triple L = gradient64(w, q.g);
    for (int m = 0; m < 4; ++m) rate[m] -= h.inverse_V64 * dot(L, a[3 + m]);
  }
  Native power = all(0);
  if (h.kept)
    for (int m = 0; m < 4; ++m) {
      const Native now = h.kept[m] + h.a * rate[m];
      power += 0.5 * (h.kept[m] + now) * rate[m];
      rate[m] = h.kept[m] = now;
    }
  else
    for (int m = 0; m < 4; ++m) power += rate[m] * rate[m], rate[m] *= h.a;
  if (!h.plain)
    for (int m = 0; m < 4; ++m) {
      const Native share = 64.0 * h.inverse_V64 * rate[m];
      T = {T.x - share * a[3 + m].x, T.y - share * a[3 + m].y, T.z - share * a[3 + m].z};
    }
  for (int m = 0; m < 6; ++m) out[m] = -0.015625 * dot(T, q.g[m]);
  for (int m = 0; m < 3; ++m) out[3 + m] -= rate[m];
  out[6] = -rate[3];
  return power;
}

COURANT_INLINE void add(Real* p, Native a, Index n) {
  store(p, load(p, n) + a, n);
}

/// k = QM rho c^2 b:b/(8 V), with which the modes are QM times as stiff as the stiffest uniform strain, b_I =
/// dV/dx_I. [M/T2]
COURANT_INLINE Native hourglass_stiffness(Native modulus, const Geometry& q, Native inverse_V64) {
  Native squares = dot(q.g[0], q.g[0]);
  for (int m = 1; m < 6; ++m) squares += dot(q.g[m], q.g[m]);
  return 0.015625 * modulus * squares * inverse_V64;
}

/// Of each direction and mode those of the step before, turned with the element.
COURANT_INLINE void turned_hourglass_forces(Index first, Index n, Index k, const HexahedronState& state,
                                            const HexahedronScratch& scratch, Native kept[3][4]) {
  const Triple h = triple(scratch.half_turn, k);
  for (int m = 0; m < 4; ++m) {
    for (int i = 0; i < 3; ++i) kept[i][m] = load(state.hourglass_force[3 * m + i] + first, n);
    turn_vector(h.x, h.y, h.z, kept[0][m], kept[1][m], kept[2][m]);
  }
}

COURANT_INLINE void forces_of(Index first, Index n, Index k, Real dt, const HexahedronControl& control,
                              const HexahedronState& state, HexahedronScratch& scratch) {
  Triple a[7];
  for (int m = 0; m < 7; ++m) a[m] = triple(scratch.place + 3 * m, k);
  const Native area = largest_face(a);
  const Geometry now = geometry(a);
  const Native V = 0.015625 * now.V64, inverse_V64 = 1.0 / now.V64;
  const Native V0 = load(state.V0 + first, n), rho = 64.0 * load(state.rho0 + first, n) * V0 * inverse_V64;
  store(scratch.relative_volume + k, V / V0);

  // bulk viscosity q = rho l (Q1 l e^2 - Q2 c e) in compression, e = tr D < 0
  const Native c = load(scratch.sound_speed + k, n), r = inverse_cube_root(V), l = V * r * r;
  const Native trace = load(scratch.rate[0] + k) + load(scratch.rate[1] + k) + load(scratch.rate[2] + k);
  const Native closing = native_max(-trace, all(0));
  const Native q = rho * l * closing * (control.Q1 * l * closing + control.Q2 * c);
  const Native length = V / area;
  // damping ratio Q/c of a wave through the thickness of the element, of which q makes more than usual where
  // it is flatter than a cube
  const Native Q = closing > 0.0 ? l / length * (control.Q2 * c + control.Q1 * l * closing) : all(0);
  store(scratch.step_limit + k, length / (Q + root(Q * Q + c * c)));
  store(scratch.wave_time + k, length / c);
  add(state.bulk_viscosity_energy + first, dt * load(scratch.middle_volume + k) * q * closing, n);

  Native s[6], w[7], modes[7], f[8], power = all(0);
  for (int j = 0; j < 6; ++j) s[j] = load(state.stress[j] + first, n);
  const Native p = state.pressure ? q + load(state.pressure + first, n) : q;
  const Triple T[3] = {{s[0] - p, s[3], s[5]}, {s[3], s[1] - p, s[4]}, {s[5], s[4], s[2] - p}};
  Native kept[3][4];
  if (control.stiff()) turned_hourglass_forces(first, n, k, state, scratch, kept);
  Hourglass hourglass{control.stiff() ? dt * hourglass_stiffness(control.QM * rho * c * c, now, inverse_V64)
                                      : 0.25 * control.QM * rho * c * l * l,
                      control.hourglass == 1, inverse_V64};
  for (int i = 0; i < 3; ++i) {
    for (int m = 0; m < 7; ++m) w[m] = load(scratch.speed[3 * m + i] + k);
    if (control.stiff()) hourglass.kept = kept[i];
    power += force_modes(a, w, now, T[i], hourglass, modes);
    corners_of(modes, f);
    for (int j = 0; j < 8; ++j) store(state.corner_force[3 * j + i] + first, f[j], n);
    if (control.stiff())
      for (int m = 0; m < 4; ++m) store(state.hourglass_force[3 * m + i] + first, kept[i][m], n);
  }
  add(state.hourglass_energy + first, (control.stiff() ? all(dt) : dt * hourglass.a) * power, n);
  if (state.internal_energy) add(state.internal_energy + first, load(scratch.work + k), n);
}

void strain(const HexahedronLoops::Block& block, const HexahedronMesh& mesh, const HexahedronState& state,
            HexahedronScratch& scratch) {
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    strain_of(block.begin + k, native_lanes, k, block.dt, mesh, state, scratch);
  if (whole < block.count)
    strain_of(block.begin + whole, block.count - whole, whole, block.dt, mesh, state, scratch);
}

void work(const HexahedronLoops::Block& block, const HexahedronState& state, HexahedronScratch& scratch) {
  const Real *dxx = scratch.rate[0], *dyy = scratch.rate[1], *dzz = scratch.rate[2], *dxy = scratch.rate[3],
             *dyz = scratch.rate[4], *dzx = scratch.rate[5], *volume = scratch.middle_volume;
  const Real *xx = state.stress[0] + block.begin, *yy = state.stress[1] + block.begin,
             *zz = state.stress[2] + block.begin, *xy = state.stress[3] + block.begin,
             *yz = state.stress[4] + block.begin, *zx = state.stress[5] + block.begin;
  const Real half = 0.5 * block.dt;
  Real* total = scratch.work;
#pragma omp simd
  for (Index i = 0; i < block.count; ++i)
    total[i] += half * volume[i] *
                (xx[i] * dxx[i] + yy[i] * dyy[i] + zz[i] * dzz[i] +
                 2 * (xy[i] * dxy[i] + yz[i] * dyz[i] + zx[i] * dzx[i]));
}

/// Which is the least; the first that is not a number, where there is one.
Index least(const Real* values, Index count) {
  Index at = 0;
  for (Index i = 1; i < count; ++i)
    if (!(values[i] >= values[at]) && values[at] == values[at]) at = i;
  return at;
}

HexahedronLoops::Found forces(const HexahedronLoops::Block& block, const HexahedronControl& control,
                              const HexahedronState& state, HexahedronScratch& scratch) {
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    forces_of(block.begin + k, native_lanes, k, block.dt, control, state, scratch);
  if (whole < block.count)
    forces_of(block.begin + whole, block.count - whole, whole, block.dt, control, state, scratch);
  const Index shortest = least(scratch.step_limit, block.count);
  const Index smallest = least(scratch.relative_volume, block.count);
  return {scratch.step_limit[shortest], block.begin + shortest, scratch.relative_volume[smallest],
          block.begin + smallest};
}

}  // namespace

HexahedronLoops hexahedron_loops() {
  return {&strain, &work, &forces};
}

}  // namespace courant::COURANT_SIMD
