// The hexahedron with 2 x 2 x 2 points (ELFORM 2), compiled once for each instruction set; see
// docs/architecture.md and hexahedron_loops.cpp.
//
// The trace of D at each point is the mean over the element, dV/dt/V, and the force of pressure is that of
// the mean pressure, p dV/dx_I: elements that keep their volume do not lock (selective reduced integration:
// Hughes 1980, Int. J. Numer. Meth. Eng. 15). The deviator is integrated in full, so that no mode has zero
// energy.
#include "elements/solid/hexahedron_modes.hpp"
#ifdef COURANT_ONCE
#include "base/instruction_set.hpp"
#include "elements/solid/formulation.hpp"
#endif

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

COURANT_INLINE void gather_of(Index first, Index n, Index k, const SolidMesh& mesh, const SolidState& state,
                              PointScratch& scratch) {
  Native x[3][7], v[3][7];
  gather_modes(mesh, first, n, k, scratch, x, v);
  Triple a[7];
  for (int m = 0; m < 7; ++m) a[m] = {x[0][m], x[1][m], x[2][m]};
  store(scratch.compression + k, 64.0 * load(state.V0 + first, n) / volume64(a) - 1.0);
}

/// Half a step's change of volume at the rates sum b_I.v_I with the positions of `later` steps from its end.
COURANT_INLINE Native opened_at(Index k, Real dt, Real later, const PointScratch& scratch) {
  Triple a[7];
  for (int m = 0; m < 7; ++m)
    a[m] = triple(scratch.position + 3 * m, k) + later * dt * triple(scratch.speed + 3 * m, k);
  const Geometry there = geometry(a);
  Native opening = all(0);
  for (int m = 0; m < 6; ++m) opening += dot(triple(scratch.speed + 3 * m, k), there.g[m]);
  return 0.0078125 * dt * opening;
}

COURANT_INLINE void begin_of(Index k, Real dt, bool heats, PointScratch& scratch) {
  if (heats)
    store(scratch.opened[0] + k, opened_at(k, dt, -1, scratch)),
        store(scratch.opened[1] + k, opened_at(k, dt, 0, scratch));
  const Real back = -0.5 * dt;
  Triple a[7], w[7];
  for (int m = 0; m < 7; ++m) {
    w[m] = triple(scratch.speed + 3 * m, k);
    a[m] = triple(scratch.position + 3 * m, k) + back * w[m];
  }
  const Geometry middle = geometry(a);
  Native opening = all(0);
  for (int m = 0; m < 6; ++m) opening += dot(w[m], middle.g[m]);
  store(scratch.mean_trace + k, opening / middle.V64);
  store(scratch.middle_volume + k, 0.015625 * middle.V64);
  for (int m = 0; m < 21; ++m) store(scratch.force[m] + k, all(0));
  store(scratch.pressure + k, all(0)), store(scratch.fastest + k, all(0)), store(scratch.work + k, all(0));
  store(scratch.least_weight + k, all(1e300));
}

COURANT_INLINE void strain_of(Index first, Index n, Index k, Real dt, const GaussPoint& at,
                              const SolidState& state, PointScratch& scratch) {
  const Real back = -0.5 * dt;
  Triple a[7], w[7], r[3], u[3], C[3];
  for (int m = 0; m < 7; ++m) {
    w[m] = triple(scratch.speed + 3 * m, k);
    a[m] = triple(scratch.position + 3 * m, k) + back * w[m];
  }
  slopes(a, at, r), slopes(w, at, u);
  const Native det = cofactors(r, C);  // 512 det J, as r is 8 times the derivatives
  store(scratch.weight + k, 0.001953125 * det);
  strain_point(first, n, k, dt, u, C, det, load(scratch.mean_trace + k), 1, state, scratch);
}

/// Forces -sum_I s grad N_I of a point on the modes of the corners, N_I = sum_k H_Ik phi_k/8 with phi = xi,
/// eta, zeta, eta zeta, zeta xi, xi eta, xi eta zeta.
COURANT_INLINE void add_of(Index first, Index n, Index k, Real dt, const GaussPoint& g,
                           const SolidState& state, PointScratch& scratch) {
  Triple a[7], r[3], C[3];
  for (int m = 0; m < 7; ++m) a[m] = triple(scratch.position + 3 * m, k);
  slopes(a, g, r);
  const Native weight = 0.001953125 * cofactors(r, C);
  Native s[6];
  for (int j = 0; j < 6; ++j) s[j] = load(state.stress[j] + first, n);
  add_work(s, dt, k, scratch);
  const Native mean = (s[0] + s[1] + s[2]) * (1.0 / 3);
  store(scratch.pressure + k, load(scratch.pressure + k) - weight * mean);
  store(scratch.fastest + k, native_max(load(scratch.fastest + k), load(scratch.sound_speed + k)));
  const Native least = load(scratch.least_weight + k);
  store(scratch.least_weight + k, weight < least ? weight : least);
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

COURANT_INLINE void forces_of(Index first, Index n, Index k, Real dt, const SolidControl& control,
                              const SolidState& state, PointScratch& scratch) {
  Triple a[7];
  for (int m = 0; m < 7; ++m) a[m] = triple(scratch.position + 3 * m, k);
  const Geometry now = geometry(a);
  store(scratch.sound_speed + k, load(scratch.fastest + k));
  const Compressed of = compressed(first, n, k, dt, control, state, now.V64, thickness(a, now.V64), scratch);
  // inside out at a point is inside out: the stress there has no meaning any more
  const Native least = load(scratch.least_weight + k);
  const Native V0 = load(state.V0 + first, n);
  store(scratch.relative_volume + k, least > 0.0 ? load(scratch.relative_volume + k) : 8.0 * least / V0);
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

void gather(const ElementBlock& block, const SolidMesh& mesh, const SolidState& state,
            PointScratch& scratch) {
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    gather_of(block.begin + k, native_lanes, k, mesh, state, scratch);
  if (whole < block.count) gather_of(block.begin + whole, block.count - whole, whole, mesh, state, scratch);
}
void begin(const ElementBlock& block, bool heats, PointScratch& scratch) {
  for (Index k = 0; k < block.count; k += native_lanes) begin_of(k, block.dt, heats, scratch);
}
void strain(const ElementBlock& block, int point, const SolidControl&, const SolidState& state,
            PointScratch& scratch) {
  const GaussPoint at(point);
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    strain_of(block.begin + k, native_lanes, k, block.dt, at, state, scratch);
  if (whole < block.count)
    strain_of(block.begin + whole, block.count - whole, whole, block.dt, at, state, scratch);
}
void add_point(const ElementBlock& block, int point, const SolidControl&, const SolidState& state,
               PointScratch& scratch) {
  const GaussPoint at(point);
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    add_of(block.begin + k, native_lanes, k, block.dt, at, state, scratch);
  if (whole < block.count)
    add_of(block.begin + whole, block.count - whole, whole, block.dt, at, state, scratch);
}
StableStep forces(const ElementBlock& block, const SolidControl& control, const SolidState& state,
                  PointScratch& scratch) {
  const Index whole = block.count - block.count % native_lanes;
  for (Index k = 0; k < whole; k += native_lanes)
    forces_of(block.begin + k, native_lanes, k, block.dt, control, state, scratch);
  if (whole < block.count)
    forces_of(block.begin + whole, block.count - whole, whole, block.dt, control, state, scratch);
  return found_in(block, scratch);
}

}  // namespace

PointLoops full_hexahedron_loops() {
  return {&gather, &begin, &strain, &add_point, &forces};
}

}  // namespace courant::COURANT_SIMD

#ifdef COURANT_ONCE
namespace courant {

PointLoops full_hexahedron_loops();
COURANT_DECLARE_VARIANTS(full_hexahedron_loops)

PointLoops full_hexahedron_loops() {
  return COURANT_VARIANT(full_hexahedron_loops)();
}

namespace {

constexpr const char* without_assumed_strains =
    "{1} is not there: the solids of part {0} are those of ELFORM 2, without the strains that make flat "
    "elements "
    "bend softer";
constexpr const char* near_cubes =
    "2 says the same without this warning; keep elements of bending parts near cubes";
const RegisterSolidFormulation eight_points{
    {.elforms = {{.number = 2, .offer = "2 (eight points; -1 and -2 become it)"},
                 {.number = -1, .warning = without_assumed_strains, .hint = near_cubes},
                 {.number = -2, .warning = without_assumed_strains, .hint = near_cubes}},
     .points = 8,
     .several = &full_hexahedron_loops}};

}  // namespace

}  // namespace courant
#endif
