#pragma once
// What loops of all solid formulations share: corners, strains and stresses at points, bulk viscosity and the
// stable step. For files that are compiled once for each instruction set: all is inlined there.
#include "elements/native_math.hpp"
#include "elements/solid/solid_loops.hpp"
#include "laws/objective.hpp"

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

/// Places and velocities of the corners.
template <int corners>
COURANT_INLINE void gather_corners(const SolidMesh& mesh, Index first, Index n, Native (&px)[3][corners],
                                   Native (&pv)[3][corners]) {
  Index last[corners][native_lanes];
  const Index* nodes[corners];
  for (int c = 0; c < corners; ++c) {
    nodes[c] = mesh.corner[c] + first;
    if (n >= native_lanes) continue;
    for (Index l = 0; l < native_lanes; ++l) last[c][l] = nodes[c][l < n ? l : n - 1];
    nodes[c] = last[c];
  }
  for (int c = 0; c < corners; ++c)  // not by component: each index is read once
    for (int d = 0; d < 3; ++d)
      px[d][c] = gather(mesh.x[d], nodes[c]), pv[d][c] = gather(mesh.v[d], nodes[c]);
}

/// D at a point of which the middle of the step is known, and what turns with it: D, stress and tensors of
/// the law by the spin (Hughes-Winget). `scale` L is the velocity gradient, with L[i] that of component i;
/// returns the turned stress in `s`. `more(D)` changes D before it is turned.
template <class More>
COURANT_INLINE void turn_state(Index first, Index n, Index k, Real dt, const Triple L[3], Native scale,
                               const More& more, const SolidState& state, SolidScratch& scratch, Native D[6],
                               Native s[6]) {
  const Native half = 0.5 * scale, turn = 0.5 * dt * half;
  const Native of_middle[6] = {scale * L[0].x,           scale * L[1].y,           scale * L[2].z,
                               half * (L[0].y + L[1].x), half * (L[1].z + L[2].y), half * (L[2].x + L[0].z)};
  for (int j = 0; j < 6; ++j) D[j] = of_middle[j];
  more(D);
  const Triple h{turn * (L[2].y - L[1].z), turn * (L[0].z - L[2].x), turn * (L[1].x - L[0].y)};
  store(scratch.half_turn[0] + k, h.x), store(scratch.half_turn[1] + k, h.y);
  store(scratch.half_turn[2] + k, h.z);
  turn_rate(h.x, h.y, h.z, D[0], D[1], D[2], D[3], D[4], D[5]);
  for (int j = 0; j < 6; ++j) store(scratch.rate[j] + k, D[j]), s[j] = load(state.stress[j] + first, n);
  turn_tensor(h.x, h.y, h.z, s[0], s[1], s[2], s[3], s[4], s[5]);
  for (int j = 0; j < 6; ++j) store(state.stress[j] + first, s[j], n);
  for (int t = 0; t < state.tensors; ++t) {
    Native kept[6];
    for (int j = 0; j < 6; ++j) kept[j] = load(state.tensor[t][j] + first, n);
    turn_tensor(h.x, h.y, h.z, kept[0], kept[1], kept[2], kept[3], kept[4], kept[5]);
    for (int j = 0; j < 6; ++j) store(state.tensor[t][j] + first, kept[j], n);
  }
}

/// Half of the work of the stress at one of several points.
COURANT_INLINE void add_work(const Native s[6], Real dt, Index k, PointScratch& scratch) {
  const auto& D = scratch.rate;
  const Native power = s[0] * load(D[0] + k) + s[1] * load(D[1] + k) + s[2] * load(D[2] + k) +
                       2.0 * (s[3] * load(D[3] + k) + s[4] * load(D[4] + k) + s[5] * load(D[5] + k));
  const Native half = 0.5 * dt * load(scratch.weight + k);
  store(scratch.work + k, load(scratch.work + k) + half * power);
}

/// det J times the gradients of three coordinates, of the derivatives r by them; returns det J.
COURANT_INLINE Native cofactors(const Triple r[3], Triple out[3]) {
  out[0] = cross(r[1], r[2]), out[1] = cross(r[2], r[0]), out[2] = cross(r[0], r[1]);
  return dot(r[0], out[0]);
}

/// Elements of a block that the register at k holds.
COURANT_INLINE Index lanes_at(Index k, const ElementBlock& block) {
  return k + native_lanes <= block.count ? native_lanes : block.count - k;
}

/// The strain of one of several points: `u` derivatives of v by three coordinates, whose gradients are C /
/// det. Of the trace, `share` is that of `trace`, which the element has there. [1/T]
COURANT_INLINE void strain_point(Index first, Index n, Index k, Real dt, const Triple u[3], const Triple C[3],
                                 Native det, Native trace, Real share, const SolidState& state,
                                 PointScratch& scratch) {
  Triple L[3];
  L[0] = u[0].x * C[0] + (u[1].x * C[1] + u[2].x * C[2]);
  L[1] = u[0].y * C[0] + (u[1].y * C[1] + u[2].y * C[2]);
  L[2] = u[0].z * C[0] + (u[1].z * C[1] + u[2].z * C[2]);
  Native D[6], s[6];
  turn_state(
      first, n, k, dt, L, 1.0 / det,
      [&](Native of_point[6]) {
        const Native lacks = (trace - of_point[0] - of_point[1] - of_point[2]) * (share / 3);
        for (int j = 0; j < 3; ++j) of_point[j] += lacks;
      },
      state, scratch, D, s);
  add_work(s, dt, k, scratch);
}

COURANT_INLINE void add(Real* p, Native a, Index n) {
  store(p, load(p, n) + a, n);
}

/// q = rho l (Q1 l e^2 - Q2 c e) in compression, e = tr D < 0, l the cube root
/// of the volume.
COURANT_INLINE Native bulk_viscosity(Native rho, Native l, Native c, Native closing,
                                     const SolidControl& control) {
  return rho * l * closing * (control.Q1 * l * closing + control.Q2 * c);
}
COURANT_INLINE Native trace_of(const SolidScratch& scratch, Index k) {
  return load(scratch.rate[0] + k) + load(scratch.rate[1] + k) + load(scratch.rate[2] + k);
}

/// What a block has at the end of a step beside its stress: density, sound speed, size, q.
struct Compressed {
  Native inverse_V64, rho, c, l, q;
};
/// Relative volume, bulk viscosity with what it takes, and the stable step. `length`: over which a wave runs
/// in a stable step.
COURANT_INLINE Compressed compressed(Index first, Index n, Index k, Real dt, const SolidControl& control,
                                     const SolidState& state, Native V64, Native length,
                                     SolidScratch& scratch) {
  const Native V = 0.015625 * V64, inverse_V64 = 1.0 / V64;
  const Native V0 = load(state.V0 + first, n), rho = 64.0 * load(state.rho0 + first, n) * V0 * inverse_V64;
  store(scratch.relative_volume + k, V / V0);

  const Native c = load(scratch.sound_speed + k, n), r = inverse_cube_root(V), l = V * r * r;
  const Native closing = native_max(-trace_of(scratch, k), all(0));
  const Native q =
      state.heats ? load(state.viscous_pressure + first, n) : bulk_viscosity(rho, l, c, closing, control);
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
inline StableStep found_in(const ElementBlock& block, const SolidScratch& scratch) {
  const Index shortest = least(scratch.step_limit, block.count);
  const Index smallest = least(scratch.relative_volume, block.count);
  return {scratch.step_limit[shortest], block.begin + shortest, scratch.relative_volume[smallest],
          block.begin + smallest};
}

}  // namespace courant::COURANT_SIMD
