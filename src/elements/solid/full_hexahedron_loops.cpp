// Compiled once for each instruction set; see docs/architecture.md and hexahedron_loops.cpp.
#include "elements/solid/full_hexahedron_loops.hpp"

#include "elements/solid/hexahedron_modes.hpp"
#include "laws/objective.hpp"

namespace courant::COURANT_SIMD {

namespace {

/// A point of Gauss: coordinates of +-1/sqrt(3), and their products.
struct GaussPoint {
  Real xi, eta, zeta, eta_zeta, zeta_xi, xi_eta;
  explicit GaussPoint(int point) {
    constexpr Real g = 0.57735026918962576451;
    xi = point & 1 ? g : -g, eta = point & 2 ? g : -g, zeta = point & 4 ? g : -g;
    eta_zeta = eta * zeta, zeta_xi = zeta * xi, xi_eta = xi * eta;
  }
};

/// 8 d/dxi, 8 d/deta, 8 d/dzeta of a vector, given by its modes.
COURANT_INLINE void slopes(const Triple a[7], const GaussPoint& g, Triple out[3]) {
  out[0] = a[0] + (g.zeta * a[4] + (g.eta * a[5] + g.eta_zeta * a[6]));
  out[1] = a[1] + (g.zeta * a[3] + (g.xi * a[5] + g.zeta_xi * a[6]));
  out[2] = a[2] + (g.eta * a[3] + (g.xi * a[4] + g.xi_eta * a[6]));
}
/// det J times the gradients of xi, eta, zeta, all times 64; returns 512 det J.
COURANT_INLINE Native cofactors(const Triple r[3], Triple out[3]) {
  out[0] = cross(r[1], r[2]), out[1] = cross(r[2], r[0]), out[2] = cross(r[0], r[1]);
  return dot(r[0], out[0]);
}

COURANT_INLINE void gather_of(Index first, Index n, Index k, const HexahedronMesh& mesh,
                              const HexahedronState& state, FullHexahedronScratch& scratch) {
  Native x[3][7], v[3][7];
  gather_modes(mesh, first, n, k, scratch, x, v);
  Triple a[7];
  for (int m = 0; m < 7; ++m) a[m] = {x[0][m], x[1][m], x[2][m]};
  store(scratch.compression + k, 64.0 * load(state.V0 + first, n) / volume64(a) - 1.0);
}

/// Half a step's change of volume at the rates sum b_I.v_I with the places of `later` steps from its end.
COURANT_INLINE Native opened_at(Index k, Real dt, Real later, const FullHexahedronScratch& scratch) {
  Triple a[7];
  for (int m = 0; m < 7; ++m)
    a[m] = triple(scratch.place + 3 * m, k) + later * dt * triple(scratch.speed + 3 * m, k);
  const Geometry there = geometry(a);
  Native opening = all(0);
  for (int m = 0; m < 6; ++m) opening += dot(triple(scratch.speed + 3 * m, k), there.g[m]);
  return 0.0078125 * dt * opening;
}

COURANT_INLINE void begin_of(Index k, Real dt, bool heats, FullHexahedronScratch& scratch) {
  if (heats)
    store(scratch.opened[0] + k, opened_at(k, dt, -1, scratch)),
        store(scratch.opened[1] + k, opened_at(k, dt, 0, scratch));
  const Real back = -0.5 * dt;
  Triple a[7], w[7];
  for (int m = 0; m < 7; ++m) {
    w[m] = triple(scratch.speed + 3 * m, k);
    a[m] = triple(scratch.place + 3 * m, k) + back * w[m];
  }
  const Geometry middle = geometry(a);
  Native opening = all(0);
  for (int m = 0; m < 6; ++m) opening += dot(w[m], middle.g[m]);
  store(scratch.mean_trace + k, opening / middle.V64);
  store(scratch.middle_volume + k, 0.015625 * middle.V64);
  for (auto& force : scratch.force) store(force + k, all(0));
  store(scratch.pressure + k, all(0)), store(scratch.fastest + k, all(0)), store(scratch.work + k, all(0));
}

COURANT_INLINE Native power_of(const Native s[6], const FullHexahedronScratch& scratch, Index k) {
  const auto& D = scratch.rate;
  return s[0] * load(D[0] + k) + s[1] * load(D[1] + k) + s[2] * load(D[2] + k) +
         2.0 * (s[3] * load(D[3] + k) + s[4] * load(D[4] + k) + s[5] * load(D[5] + k));
}
COURANT_INLINE void add_work(const Native s[6], Real dt, Index k, FullHexahedronScratch& scratch) {
  const Native half = 0.5 * dt * load(scratch.weight + k);
  store(scratch.work + k, load(scratch.work + k) + half * power_of(s, scratch, k));
}

COURANT_INLINE void strain_of(Index first, Index n, Index k, Real dt, const GaussPoint& at,
                              const HexahedronState& state, FullHexahedronScratch& scratch) {
  const Real back = -0.5 * dt;
  Triple a[7], w[7], r[3], u[3], C[3], L[3];
  for (int m = 0; m < 7; ++m) {
    w[m] = triple(scratch.speed + 3 * m, k);
    a[m] = triple(scratch.place + 3 * m, k) + back * w[m];
  }
  slopes(a, at, r), slopes(w, at, u);
  const Native det = cofactors(r, C), scale = 1.0 / det, half = 0.5 * scale, turn = 0.5 * dt * half;
  store(scratch.weight + k, 0.001953125 * det);
  L[0] = u[0].x * C[0] + (u[1].x * C[1] + u[2].x * C[2]);
  L[1] = u[0].y * C[0] + (u[1].y * C[1] + u[2].y * C[2]);
  L[2] = u[0].z * C[0] + (u[1].z * C[1] + u[2].z * C[2]);
  Native D[6] = {scale * L[0].x,           scale * L[1].y,           scale * L[2].z,
                 half * (L[0].y + L[1].x), half * (L[1].z + L[2].y), half * (L[2].x + L[0].z)};
  const Native lacks = (load(scratch.mean_trace + k) - D[0] - D[1] - D[2]) * (1.0 / 3);
  for (int j = 0; j < 3; ++j) D[j] += lacks;
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
  add_work(s, dt, k, scratch);
}

/// Forces -sum_I s grad N_I of a point on the modes of the corners, N_I = sum_k H_Ik phi_k/8 with phi = xi,
/// eta, zeta, eta zeta, zeta xi, xi eta, xi eta zeta.
COURANT_INLINE void add_of(Index first, Index n, Index k, Real dt, const GaussPoint& g,
                           const HexahedronState& state, FullHexahedronScratch& scratch) {
  Triple a[7], r[3], C[3];
  for (int m = 0; m < 7; ++m) a[m] = triple(scratch.place + 3 * m, k);
  slopes(a, g, r);
  const Native weight = 0.001953125 * cofactors(r, C);
  Native s[6];
  for (int j = 0; j < 6; ++j) s[j] = load(state.stress[j] + first, n);
  add_work(s, dt, k, scratch);
  const Native mean = (s[0] + s[1] + s[2]) * (1.0 / 3);
  store(scratch.pressure + k, load(scratch.pressure + k) - weight * mean);
  store(scratch.fastest + k, native_max(load(scratch.fastest + k), load(scratch.sound_speed + k)));
  for (int j = 0; j < 3; ++j) s[j] -= mean;
  const Triple T[3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
  for (int i = 0; i < 3; ++i) {
    const Native p1 = -0.001953125 * dot(T[i], C[0]), p2 = -0.001953125 * dot(T[i], C[1]),
                 p3 = -0.001953125 * dot(T[i], C[2]);
    const Native modes[7] = {p1,
                             p2,
                             p3,
                             g.zeta * p2 + g.eta * p3,
                             g.zeta * p1 + g.xi * p3,
                             g.eta * p1 + g.xi * p2,
                             g.eta_zeta * p1 + g.zeta_xi * p2 + g.xi_eta * p3};
    for (int m = 0; m < 7; ++m) {
      Real* force = scratch.force[3 * m + i] + k;
      store(force, load(force) + modes[m]);
    }
  }
}

COURANT_INLINE void forces_of(Index first, Index n, Index k, Real dt, const HexahedronControl& control,
                              const HexahedronState& state, FullHexahedronScratch& scratch) {
  Triple a[7];
  for (int m = 0; m < 7; ++m) a[m] = triple(scratch.place + 3 * m, k);
  const Geometry now = geometry(a);
  store(scratch.sound_speed + k, load(scratch.fastest + k));
  const Compressed of = compressed(first, n, k, dt, control, state, a, now.V64, scratch);
  // 64 p dV/da of the modes, with the volume that is in the mean of p
  const Native p = load(scratch.pressure + k) * of.inverse_V64 + 0.015625 * of.q;
  for (int i = 0; i < 3; ++i) {
    Native modes[7], f[8];
    for (int m = 0; m < 7; ++m) modes[m] = load(scratch.force[3 * m + i] + k);
    for (int m = 0; m < 6; ++m) modes[m] += p * (i == 0 ? now.g[m].x : i == 1 ? now.g[m].y : now.g[m].z);
    corners_of(modes, f);
    for (int j = 0; j < 8; ++j) store(state.corner_force[3 * j + i] + first, f[j], n);
  }
  if (state.internal_energy) add(state.internal_energy + first, load(scratch.work + k), n);
}

void gather(const FullHexahedronLoops::Block& block, const HexahedronMesh& mesh, const HexahedronState& state,
            FullHexahedronScratch& scratch) {
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    gather_of(block.begin + k, native_lanes, k, mesh, state, scratch);
  if (whole < block.count) gather_of(block.begin + whole, block.count - whole, whole, mesh, state, scratch);
}
void begin(const FullHexahedronLoops::Block& block, bool heats, FullHexahedronScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes) begin_of(k, block.dt, heats, scratch);
}
void strain(const FullHexahedronLoops::Block& block, int point, const HexahedronState& state,
            FullHexahedronScratch& scratch) {
  const GaussPoint at(point);
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    strain_of(block.begin + k, native_lanes, k, block.dt, at, state, scratch);
  if (whole < block.count)
    strain_of(block.begin + whole, block.count - whole, whole, block.dt, at, state, scratch);
}
void add_point(const FullHexahedronLoops::Block& block, int point, const HexahedronState& state,
               FullHexahedronScratch& scratch) {
  const GaussPoint at(point);
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    add_of(block.begin + k, native_lanes, k, block.dt, at, state, scratch);
  if (whole < block.count)
    add_of(block.begin + whole, block.count - whole, whole, block.dt, at, state, scratch);
}
HexahedronLoops::StableStep forces(const FullHexahedronLoops::Block& block, const HexahedronControl& control,
                                   const HexahedronState& state, FullHexahedronScratch& scratch) {
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    forces_of(block.begin + k, native_lanes, k, block.dt, control, state, scratch);
  if (whole < block.count)
    forces_of(block.begin + whole, block.count - whole, whole, block.dt, control, state, scratch);
  return found_in(block, scratch);
}

}  // namespace

FullHexahedronLoops full_hexahedron_loops() {
  return {&gather, &begin, &strain, &add_point, &forces};
}

}  // namespace courant::COURANT_SIMD
