// Compiled once for each instruction set; see docs/architecture.md. Nothing here may be shared with other
// files. A register holds as many elements as it has space for; what is behind the last element of a block
// repeats that one and is not stored.
//
// The hexahedron with one point (ELFORM 1), and what becomes of it where nodes repeat.
//
// Positions and velocities of an element are taken as eight modes: a_k = sum_I H_Ik x_I, with H the signs of
// 1, xi, eta, zeta, eta zeta, zeta xi, xi eta, xi eta zeta at corner I. The volume of a hexahedron with
// bilinear faces is a polynomial in them,
//   64 V = a1.(a2 x a3) + (a5.(a4 x a3) + a6.(a2 x a4) + a1.(a6 x a5))/3,
// so its derivatives by the corners, b_I = dV/dx_I = sum_k H_Ik dV/da_k, are exact and cost a few cross
// products, and the modes of hourglass control (Flanagan & Belytschko 1981) are those from a4 on.
#include "elements/solid/hexahedron_modes.hpp"
#ifdef COURANT_ONCE
#include "base/instruction_set.hpp"
#include "elements/solid/formulation.hpp"
#endif

namespace courant::COURANT_SIMD {

namespace {

/// 64 dV/dt where the modes of positions have these derivatives.
COURANT_INLINE Native opening64(const Native v[3][7], const Geometry& at) {
  Native out = v[0][0] * at.g[0].x + v[1][0] * at.g[0].y + v[2][0] * at.g[0].z;
  for (int m = 1; m < 6; ++m) out += v[0][m] * at.g[m].x + v[1][m] * at.g[m].y + v[2][m] * at.g[m].z;
  return out;
}

/// 64 V times the gradient of one component of v, given by its modes. Those above 6 have no part in it.
COURANT_INLINE Triple gradient64(const Native w[7], const Triple g[6]) {
  Triple out{w[0] * g[0].x, w[0] * g[0].y, w[0] * g[0].z};
  for (int k = 1; k < 6; ++k) out = {out.x + w[k] * g[k].x, out.y + w[k] * g[k].y, out.z + w[k] * g[k].z};
  return out;
}

/// What the work of the mean stress is more through `opened` than through tr(D) V dt/2 of the middle.
COURANT_INLINE Native mean_stress_otherwise(int end, Index k, Real dt, const Native s[3],
                                            const SolidScratch& scratch) {
  const Native middle = 0.5 * dt * load(scratch.middle_volume + k) * trace_of(scratch, k);
  return (1.0 / 3) * (s[0] + s[1] + s[2]) * (load(scratch.opened[end] + k) - middle);
}

/// Rates of the modes of hourglass control that linear fields leave alone, instead of the plain ones.
/// With the geometry in the middle of the step: that at its end would strain what turns, and a stiffness then
/// makes energy without bound.
COURANT_INLINE void orthogonal_rates(const Triple middle[7], const Native v[3][7], const Triple L[3],
                                     Native inverse_V64, Index k, SolidScratch& scratch) {
  for (int m = 3; m < 7; ++m)
    for (int i = 0; i < 3; ++i)
      store(scratch.speed[3 * m + i] + k, v[i][m] - inverse_V64 * dot(L[i], middle[m]));
}

COURANT_INLINE void strain_of(Index first, Index n, Index k, Real dt, const SolidMesh& mesh,
                              const SolidControl& control, const SolidState& state, SolidScratch& scratch) {
  Native x[3][7], v[3][7];
  gather_modes(mesh, first, n, k, scratch, x, v);
  Triple a[7], L[3];
  for (int m = 0; m < 7; ++m) a[m] = {x[0][m], x[1][m], x[2][m]};
  store(scratch.compression + k, 64.0 * load(state.V0 + first, n) / volume64(a) - 1.0);
  if (state.heats) {
    store(scratch.opened[1] + k, (0.0078125 * dt) * opening64(v, geometry(a)));
    for (int m = 0; m < 7; ++m)
      a[m] = {x[0][m] - dt * v[0][m], x[1][m] - dt * v[1][m], x[2][m] - dt * v[2][m]};
    store(scratch.opened[0] + k, (0.0078125 * dt) * opening64(v, geometry(a)));
  }
  const Real back = -0.5 * dt;
  for (int m = 0; m < 7; ++m)
    a[m] = {x[0][m] + back * v[0][m], x[1][m] + back * v[1][m], x[2][m] + back * v[2][m]};
  const Geometry middle = geometry(a);
  for (int i = 0; i < 3; ++i) L[i] = gradient64(v[i], middle.g);
  if (control.hourglass != 1) orthogonal_rates(a, v, L, 1.0 / middle.V64, k, scratch);
  const Native V = 0.015625 * middle.V64;
  store(scratch.middle_volume + k, V);
  Native D[6], s[6];
  turn_state(
      first, n, k, dt, L, 1.0 / middle.V64, [](Native*) {}, state, scratch, D, s);
  const Native power =
      s[0] * D[0] + s[1] * D[1] + s[2] * D[2] + 2.0 * (s[3] * D[3] + s[4] * D[4] + s[5] * D[5]);
  Native work = 0.5 * dt * V * power;
  if (state.heats) work += mean_stress_otherwise(0, k, dt, s, scratch);
  store(scratch.work + k, work);
}

/// One component of the corner forces, by its modes: -T b and those of hourglass control, -a Gamma (rate), or
/// -Gamma (what a stiffness has made of all rates). Returns the power of the mean of the forces before and
/// now: each pushes through half a step. With the modes gamma that linear fields leave alone, gamma = Gamma -
/// b.(sum x Gamma)/V, the second term of the forces has the form of a stress.
struct Hourglass {
  Native a;  ///< force over rate of a mode [M/T]; with a stiffness its growth in the step
  bool plain, stiff;
  Native inverse_V64;
  Native* kept = nullptr;         ///< forces of the four modes, with a stiffness turned; out: now [ML/T2]
  const Native* given = nullptr;  ///< IHQ 6: all is done, these are the forces [ML/T2]
};
COURANT_INLINE Native force_modes(const Triple a[7], const Native rate[4], const Geometry& q, Triple T,
                                  const Hourglass& h, Native out[7]) {
  Native now[4], power = all(0);
  for (int m = 0; m < 4; ++m) {
    if (h.given) {
      now[m] = h.given[m];
      continue;
    }
    now[m] = h.stiff ? h.kept[m] + h.a * rate[m] : h.a * rate[m];
    power += 0.5 * (h.kept[m] + now[m]) * rate[m];
    h.kept[m] = now[m];
  }
  if (!h.plain)
    for (int m = 0; m < 4; ++m) {
      const Native share = 64.0 * h.inverse_V64 * now[m];
      T = {T.x - share * a[3 + m].x, T.y - share * a[3 + m].y, T.z - share * a[3 + m].z};
    }
  for (int m = 0; m < 6; ++m) out[m] = -0.015625 * dot(T, q.g[m]);
  for (int m = 0; m < 3; ++m) out[3 + m] -= now[m];
  out[6] = -now[3];
  return power;
}

/// k = QM rho c^2 b:b/(8 V), with which the modes are QM times as stiff as the stiffest uniform strain, b_I =
/// dV/dx_I. [M/T2]
COURANT_INLINE Native hourglass_stiffness(Native modulus, const Geometry& q, Native inverse_V64) {
  Native squares = dot(q.g[0], q.g[0]);
  for (int m = 1; m < 6; ++m) squares += dot(q.g[m], q.g[m]);
  return 0.015625 * modulus * squares * inverse_V64;
}

/// Belytschko & Bindeman 1993, ASQBI, as a brick along the axes e of the element has it, of half lengths l.
/// A mode of amplitude q strains it, with b, c, d different and the signs of mode b those of xi_c xi_d: along
/// d by A = q_dc xi_b/l_d together with C = q_cd xi_b/l_c, where the stress along b is 0; by 2 D_bc =
/// (q_bb/l_c + q_cc/l_b) xi_d; by q_b4 xi_c xi_d/l_b, where the stress is along b. No other strains: so
/// bending is not stiffer than it is. `kept`: forces of the modes along e, before and out: now. [ML/T2]
struct AssumedStrain {
  Triple e[3];
  Native length[3];
};
COURANT_INLINE AssumedStrain axes_of(const Triple a[3]) {
  AssumedStrain out;
  out.e[0] = (1.0 / root(dot(a[0], a[0]))) * a[0];
  const Native along = dot(a[1], out.e[0]);
  const Triple second{a[1].x - along * out.e[0].x, a[1].y - along * out.e[0].y, a[1].z - along * out.e[0].z};
  out.e[1] = (1.0 / root(dot(second, second))) * second;
  out.e[2] = cross(out.e[0], out.e[1]);
  for (int i = 0; i < 3; ++i) out.length[i] = 0.125 * dot(a[i], out.e[i]);
  return out;
}
COURANT_INLINE void strain_modes(const Native q[3][4], const Native l[3], Native V,
                                 const SolidControl& control, Native kept[3][4]) {
  const Native bending = control.QM * control.plate_modulus / 3 * V, shear = control.QM * control.G / 3 * V,
               along = control.QM * control.E / 9 * V;
  for (int b = 0; b < 3; ++b) {
    const int c = (b + 1) % 3, d = (b + 2) % 3;
    const Native A = q[d][c] / l[d], C = q[c][d] / l[c];
    kept[d][c] += bending * (A + control.nu * C) / l[d];
    kept[c][d] += bending * (C + control.nu * A) / l[c];
    const Native D = shear * (q[b][b] / l[c] + q[c][c] / l[b]);
    kept[b][b] += D / l[c], kept[c][c] += D / l[b];
    kept[b][3] += along * q[b][3] / (l[b] * l[b]);
  }
}
/// Rates of the modes along the axes in the middle of the step. `force`: out, along space, as elements lie at
/// the end of the step. Returns the power.
COURANT_INLINE Native assumed_strain_forces(const Triple a[7], const Native rate[3][4], Real dt, Index k,
                                            const SolidControl& control, const SolidScratch& scratch,
                                            Native kept[3][4], Native force[3][4]) {
  Triple middle[3];
  for (int m = 0; m < 3; ++m) middle[m] = a[m] - (0.5 * dt) * triple(scratch.speed + 3 * m, k);
  const AssumedStrain brick = axes_of(middle), end = axes_of(a);
  Native local[3][4], strained[3][4], old[3][4], power = all(0);
  for (int b = 0; b < 3; ++b)
    for (int m = 0; m < 4; ++m) {
      local[b][m] = dot(brick.e[b], Triple{rate[0][m], rate[1][m], rate[2][m]});
      strained[b][m] = 0.015625 * dt * local[b][m];  // amplitudes are 1/8 of sums over corners, twice
      old[b][m] = kept[b][m];
    }
  strain_modes(strained, brick.length, load(scratch.middle_volume + k), control, kept);
  for (int b = 0; b < 3; ++b)
    for (int m = 0; m < 4; ++m) power += 0.5 * (old[b][m] + kept[b][m]) * local[b][m];
  for (int m = 0; m < 4; ++m) {
    force[0][m] = force[1][m] = force[2][m] = all(0);
    for (int b = 0; b < 3; ++b) {
      force[0][m] += kept[b][m] * end.e[b].x, force[1][m] += kept[b][m] * end.e[b].y;
      force[2][m] += kept[b][m] * end.e[b].z;
    }
  }
  return power;
}

/// Of each direction and mode those of the step before; a stiffness turns with the element, and so do its
/// rates from the middle of the step.
COURANT_INLINE void old_hourglass_forces(Index first, Index n, Index k, bool stiff, const SolidState& state,
                                         const SolidScratch& scratch, Native kept[3][4], Native rate[3][4]) {
  for (int m = 0; m < 4; ++m)
    for (int i = 0; i < 3; ++i) kept[i][m] = load(state.hourglass_force[3 * m + i] + first, n);
  if (!stiff) return;
  const Triple h = triple(scratch.half_turn, k), half = 0.5 * h;
  for (int m = 0; m < 4; ++m) {
    turn_vector(h.x, h.y, h.z, kept[0][m], kept[1][m], kept[2][m]);
    turn_vector(half.x, half.y, half.z, rate[0][m], rate[1][m], rate[2][m]);
  }
}

COURANT_INLINE void viscosity_of(Index first, Index n, Index k, const SolidControl& control,
                                 const SolidState& state, SolidScratch& scratch) {
  const Native denser = 1.0 + load(scratch.compression + k), V = load(state.V0 + first, n) / denser;
  const Native r = inverse_cube_root(V), l = V * r * r;
  const Native q = bulk_viscosity(load(state.rho0 + first, n) * denser, l, load(scratch.sound_speed + k),
                                  native_max(-trace_of(scratch, k), all(0)), control);
  const Native taken =
      load(state.viscous_pressure + first, n) * load(scratch.opened[0] + k) + q * load(scratch.opened[1] + k);
  store(scratch.work + k, load(scratch.work + k) - taken);
  store(state.viscous_pressure + first, q, n);
}

COURANT_INLINE void forces_of(Index first, Index n, Index k, Real dt, const SolidControl& control,
                              const SolidState& state, SolidScratch& scratch) {
  Triple a[7];
  for (int m = 0; m < 7; ++m) a[m] = triple(scratch.position + 3 * m, k);
  const Geometry now = geometry(a);
  const Compressed of = compressed(first, n, k, dt, control, state, now.V64, thickness(a, now.V64), scratch);
  const Native inverse_V64 = of.inverse_V64, rho = of.rho, c = of.c, l = of.l, q = of.q;

  Native s[6], rate[3][4], modes[7], f[8], power = all(0);
  for (int j = 0; j < 6; ++j) s[j] = load(state.stress[j] + first, n);
  const Triple T[3] = {{s[0] - q, s[3], s[5]}, {s[3], s[1] - q, s[4]}, {s[5], s[4], s[2] - q}};
  Native kept[3][4]{};
  const bool keeps = state.hourglass_force[0] != nullptr;
  const bool assumes = keeps && control.hourglass == 6;  // whose forces lie along axes of the element
  for (int i = 0; i < 3; ++i)
    for (int m = 0; m < 4; ++m) rate[i][m] = load(scratch.speed[3 * (3 + m) + i] + k);
  if (keeps) old_hourglass_forces(first, n, k, control.stiff() && !assumes, state, scratch, kept, rate);
  Hourglass hourglass{control.stiff() ? dt * hourglass_stiffness(control.QM * rho * c * c, now, inverse_V64)
                                      : 0.25 * control.QM * rho * c * l * l,
                      control.hourglass == 1, control.stiff(), inverse_V64};
  Native given[3][4];
  if (assumes) power += assumed_strain_forces(a, rate, dt, k, control, scratch, kept, given);
  for (int i = 0; i < 3; ++i) {
    hourglass.kept = kept[i];
    hourglass.given = assumes ? given[i] : nullptr;
    power += force_modes(a, rate[i], now, T[i], hourglass, modes);
    corners_of(modes, f);
    for (int j = 0; j < 8; ++j) store(state.corner_force[3 * j + i] + first, f[j], n);
    if (keeps)
      for (int m = 0; m < 4; ++m) store(state.hourglass_force[3 * m + i] + first, kept[i][m], n);
  }
  add(state.hourglass_energy + first, dt * power, n);
  if (state.internal_energy) add(state.internal_energy + first, load(scratch.work + k), n);
}

void strain(const ElementBlock& block, const SolidMesh& mesh, const SolidControl& control,
            const SolidState& state, SolidScratch& scratch) {
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    strain_of(block.begin + k, native_lanes, k, block.dt, mesh, control, state, scratch);
  if (whole < block.count)
    strain_of(block.begin + whole, block.count - whole, whole, block.dt, mesh, control, state, scratch);
}

void viscosity(const ElementBlock& block, const SolidControl& control, const SolidState& state,
               SolidScratch& scratch) {
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    viscosity_of(block.begin + k, native_lanes, k, control, state, scratch);
  if (whole < block.count)
    viscosity_of(block.begin + whole, block.count - whole, whole, control, state, scratch);
}

void work(const ElementBlock& block, const SolidState& state, SolidScratch& scratch) {
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
  if (!state.heats) return;
  const Real* opened = scratch.opened[1];
#pragma omp simd
  for (Index i = 0; i < block.count; ++i)
    total[i] +=
        (1.0 / 3) * (xx[i] + yy[i] + zz[i]) * (opened[i] - half * volume[i] * (dxx[i] + dyy[i] + dzz[i]));
}

StableStep forces(const ElementBlock& block, const SolidControl& control, const SolidState& state,
                  SolidScratch& scratch) {
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    forces_of(block.begin + k, native_lanes, k, block.dt, control, state, scratch);
  if (whole < block.count)
    forces_of(block.begin + whole, block.count - whole, whole, block.dt, control, state, scratch);
  return found_in(block, scratch);
}

}  // namespace

OnePointLoops hexahedron_loops() {
  return {&strain, &viscosity, &work, &forces};
}

}  // namespace courant::COURANT_SIMD

#ifdef COURANT_ONCE
namespace courant {

COURANT_DECLARE_VARIANTS(hexahedron_loops)

OnePointLoops hexahedron_loops() {
  return COURANT_VARIANT(hexahedron_loops)();
}

namespace {

const RegisterSolidFormulation one_point{
    {.elforms = {{.number = 1, .offer = "0, 1 (one point and hourglass control by *HOURGLASS)"},
                 {.number = 15,
                  .nodes = 6,
                  .shape = "pentahedra",
                  .offer = "15 and 115 (pentahedra)",
                  .warning = "pentahedra of part {0} have one point here, not 2"},
                 {.number = 115, .nodes = 6, .shape = "pentahedra"}},
     .one_point = &hexahedron_loops,
     .has_modes = true}};
const RegisterSolidFormulation tetrahedra{
    {.elforms = {{.number = 10, .nodes = 4, .shape = "tetrahedra", .offer = "10 (tetrahedra)"}},
     .one_point = &hexahedron_loops}};
const RegisterSolidFormulation nodal_pressures{
    {.elforms = {{.number = 13,
                  .nodes = 4,
                  .shape = "tetrahedra",
                  .offer = "13 (tetrahedra with pressures averaged over nodes)"}},
     .one_point = &hexahedron_loops,
     .nodal_pressure = true}};

}  // namespace

}  // namespace courant
#endif
